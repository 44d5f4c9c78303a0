// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/pictures/crowd_renders.h"

namespace crowdface {

/// What write_sheets left in the folder.
struct WrittenSheets {
  std::size_t pages = 0;  ///< that the faces take
  std::vector<std::filesystem::path> files;
};

/// Writes the contact sheets of a crowd from the pictures in its folder: the faces, the heads, each
/// family, an index; removes what an earlier run left over.
WrittenSheets write_sheets(const Config& config, const Config::ContactSheet& sheet,
                           const Inputs& inputs, const CrowdDirectory& directory,
                           const CrowdRenders& renders, const FaceShapes& shapes,
                           const std::vector<CastFace>& crowd, const Likeness& likeness);

/// How many pages a crowd's contact sheets have.
std::size_t sheet_page_count(const Config::ContactSheet& sheet, std::size_t faces);

}  // namespace crowdface
