// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/heads/head_texture_files.h"
#include "crowdface/heads/head_textures.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/texture/surface_texels.h"

namespace crowdface {

/// Where an image of the layout comes from: the first head that uses the image, and that head's
/// first polygon with it.
struct PictureSource {
  std::size_t head = 0;          ///< index of the first head that uses the image
  std::uint32_t file_index = 0;  ///< index of the image file in the head's `files`
  Index polygon = 0;             ///< index of this head's first polygon that uses the image
};

/// Assigns to each polygon the image of the first head that has a texture at this polygon. The
/// images have no size yet.
/// \return one source per image
std::vector<PictureSource> lay_out_pictures(const FoundTextureFiles& found, TextureLayout& layout);

/// Names the images after their materials and tiles.
/// \param pictures  result of lay_out_pictures
std::vector<PictureName> picture_names(const FoundTextureFiles& found,
                                       const std::vector<PictureSource>& pictures,
                                       const PolygonMaterials& materials);

}  // namespace crowdface
