// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/core/problems.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/pictures/crowd_renders.h"

namespace crowdface {

/// Adds what is wrong with the mesh, if it is one, that the faces are to be compared with.
void check_compared_mesh(const Config& config, const Inputs& inputs, Problems& problems);

/// \throws MissingInput if they are to be compared with those of a crowd that lacks one of them:
/// better told before the faces are made than after.
void check_compared_crowd(const Config& config, const std::vector<CastFace>& crowd);

/// What write_sheets left in the folder.
struct WrittenSheets {
  std::size_t pages = 0;  ///< that the faces take
  std::vector<std::filesystem::path> files;
};

/// Writes the contact sheets of a crowd from the pictures in its folder: the faces, the heads, each
/// family, an index; removes what an earlier run left over.
WrittenSheets write_sheets(const Config& config, const Config::ContactSheet& sheet,
                           const Inputs& inputs, const CrowdDirectory& directory,
                           const CrowdRenders& renders, const std::vector<CastFace>& crowd,
                           const Likeness& likeness);

/// How many pages a crowd's contact sheets have.
std::size_t sheet_page_count(const Config::ContactSheet& sheet, std::size_t faces);

/// How the faces follow each other: indices into the crowd.
std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<CastFace>& crowd,
                                     const Likeness& likeness);

/// What stands under a face, a line for each label.
std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<CastFace>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads);

}  // namespace crowdface
