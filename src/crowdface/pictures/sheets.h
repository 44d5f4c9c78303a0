// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/pictures/sheet_writer.h"

namespace crowdface {

/// Result of write_sheets.
struct WrittenSheets {
  std::size_t pages = 0;  ///< number of sheet pages that show the crowd's faces
  std::vector<std::filesystem::path> files;
};

/// Writes the contact sheets of a crowd from the renders in its folder: faces, heads, families and
/// an index. Removes outdated sheets of earlier runs.
WrittenSheets write_sheets(const PicturedCrowd& crowd);

/// Adds the pages `shapes_001` … with one row per face: the neutral face, then each blend shape,
/// all seen from the front. The first row shows the template. The following rows show the first
/// faces of the crowd, as many as the config requests. Reads the meshes of these faces from the
/// crowd's folder.
void add_shape_pages(const PicturedCrowd& crowd, SheetWriter& pages);

/// Returns the number of contact-sheet pages that `faces` faces fill.
std::size_t sheet_page_count(const Config::ContactSheet& sheet, std::size_t faces);

}  // namespace crowdface
