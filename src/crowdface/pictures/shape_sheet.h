// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/pictures/sheet_writer.h"

namespace crowdface {

/// Adds pages `shapes_001` … of faces and their shapes: a row a face, first at rest, then each shape,
/// from the front. The template stands above them all.
/// \param crowd  its first `sheet.shapes` are shown, from their meshes in the folder.
void add_shape_pages(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs,
                     const CrowdDirectory& directory, const CrowdRenders& renders,
                     const FaceShapes& shapes, const std::vector<CastFace>& crowd,
                     SheetWriter& pages);

}  // namespace crowdface
