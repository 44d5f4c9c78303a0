// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/run/mesh_level.h"

namespace crowdface {

/// How GLB files of this crowd are written: frame, materials, textures, shapes.
/// \param shared  as MeshSource has it
GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared = {});

/// The same on a level.
GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared,
                       const MeshLevel& level);

}  // namespace crowdface
