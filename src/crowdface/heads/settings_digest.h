// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The hash of what a mesh depends on beside its recipe: topology, heads, masks, and the smoothing
/// settings. Each recipe of a plan carries it.
Digest settings_digest(const Config& config, const Inputs& inputs);

/// The hash of the material files that the heads name, and of the textures there that no other digest covers:
/// what a surface looks like beside its colours. Zero if there are none.
Digest materials_digest(const Inputs& inputs);

}  // namespace crowdface
