// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/glb_template.h"

namespace crowdface {

/// How GLB files of this crowd are written: frame, materials, textures, shapes.
/// \param shared  as MeshWriters takes it
GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared = {});

/// The same for a level of detail. \param whole  of the whole mesh.
GlbOptions glb_options(GlbOptions whole, const DetailLevel& level, const ShapeSet& shapes);

}  // namespace crowdface
