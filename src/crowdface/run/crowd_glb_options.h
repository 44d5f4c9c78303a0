// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/run/mesh_level.h"

namespace crowdface {

/// Options for the crowd's GLB files: axes and units, materials, textures, shapes.
/// \param shared  see MeshSource::shared_folder
GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared = {});

/// Options for GLB files at a level of detail.
GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared,
                       const MeshLevel& level);

}  // namespace crowdface
