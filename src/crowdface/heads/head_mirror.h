// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/find_mirror.h"

namespace crowdface {

/// The config's key by which faces are mirrored, or differ more or less from left to right; empty: none.
std::string mirroring_key(const Config& config);

/// The other side of each vertex of these heads.
FoundMirror find_mirror(const Config& config, const Inputs& inputs);

/// The map by which faces are mirrored: that of the inputs, or it is found now.
/// \param key  what asks for it
/// \throws InvalidInput where too few vertices have another side.
std::shared_ptr<const MirrorMap> mirror_for(const Config& config, const Inputs& inputs,
                                            const std::string& key);

/// How many vertices have another side, for people to read.
std::string describe_mirror(const Config& config, const FoundMirror& mirror);

}  // namespace crowdface
