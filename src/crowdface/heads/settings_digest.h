// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Hash of everything besides its recipe that a mesh depends on: topology, heads, masks, and
/// smoothing settings. Each recipe of a plan contains it.
Digest settings_digest(const Config& config, const Inputs& inputs);

/// Hash of the heads' material files and of those of their textures that no other hash covers: what
/// a surface looks like besides its colours. Zero if there are none.
Digest materials_digest(const Inputs& inputs);

}  // namespace crowdface
