// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/pictures/sheet_writer.h"

namespace crowdface {

/// What write_sheets left in the folder.
struct WrittenSheets {
  std::size_t pages = 0;  ///< that the faces take
  std::vector<std::filesystem::path> files;
};

/// Writes the contact sheets of a crowd from the pictures in its folder: the faces, the heads, each
/// family, an index; removes what an earlier run left over.
WrittenSheets write_sheets(const PicturedCrowd& crowd);

/// Adds pages `shapes_001` … of faces and their shapes: a row a face, first at rest, then each shape,
/// from the front. The template stands above them all.
/// \param crowd  its first faces are shown, as many as the sheet asks for, from their meshes in the folder.
void add_shape_pages(const PicturedCrowd& crowd, SheetWriter& pages);

/// How many pages a crowd's contact sheets have.
std::size_t sheet_page_count(const Config::ContactSheet& sheet, std::size_t faces);

}  // namespace crowdface
