// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Hash of everything that a mesh depends on besides its recipe: topology, heads, masks, and
/// smoothing settings. Each recipe of a plan contains this hash.
Digest settings_digest(const Config& config, const Inputs& inputs);

/// Hash of the heads' material files and of the textures that no other hash covers. The appearance
/// of the surfaces, except their colours, depends on these files. Zero if there are no such files.
Digest materials_digest(const Inputs& inputs);

}  // namespace crowdface
