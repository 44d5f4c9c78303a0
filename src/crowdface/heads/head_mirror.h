// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/find_mirror.h"

namespace crowdface {

/// The first config key that mirrors faces or changes their left-right asymmetry; empty if there is
/// none.
std::string mirroring_key(const Config& config);

/// The mirror partner of each vertex of the heads.
FoundMirror find_mirror(const Config& config, const Inputs& inputs);

/// Returns the mirror map of the inputs. Computes the map if the inputs have none.
/// \param key  the config key that needs the map, for messages
/// \throws InvalidInput if too few vertices have a mirror partner.
std::shared_ptr<const MirrorMap> required_mirror_map(const Config& config, const Inputs& inputs,
                                                     const std::string& key);

/// A readable summary: how many vertices have a mirror partner.
std::string describe_mirror(const Config& config, const FoundMirror& mirror);

}  // namespace crowdface
