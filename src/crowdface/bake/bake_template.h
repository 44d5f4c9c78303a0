// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/bake/scan_colours.h"
#include "crowdface/heads/head_textures.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/texture/surface_texels.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// The texture layout and the colours of a template, for baking any number of scans.
///
/// Each texture file that the template's skin uses gives a picture (an image to bake). Skin without
/// a texture gets a picture for each material and UDIM tile.
class BakeTemplate {
 public:
  /// \param file, shape  the file and the shape of the template; must outlive this object.
  /// \param size  width and height of each picture, in texels.
  /// \throws InvalidInput if the skin has no texture coordinates.
  BakeTemplate(const ObjFile& file, const WrapTemplate& shape, int size);

  const WrapTemplate& shape() const { return shape_; }
  /// #pictures: the name of each picture.

  const std::vector<PictureName>& names() const { return names_; }
  /// The index of the picture of each baked material.
  const std::map<std::string, std::size_t>& pictures_by_material() const {
    return pictures_by_material_;
  }
  const SurfaceTexels& texels(std::size_t picture) const { return texels_[picture]; }
  /// The template's own texture that corresponds to a picture; nullptr if there is none.
  const FilteredTexture* texture(std::size_t picture) const { return textures_[picture]; }
  /// Messages about missing or unreadable files of the template.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Marks vertices outside the skin.
  static constexpr std::uint32_t kNotSkin = kNoIndex;
  /// #V: row of the skin of each vertex of the template, or kNotSkin.
  const std::vector<std::uint32_t>& skin_rows() const { return skin_rows_; }

  /// The texture coordinate of a vertex in a picture.
  struct PictureVertex {
    std::uint32_t picture = kNoIndex;  ///< kNoIndex: the vertex is in no picture
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    double uv_per_mm = 0;  ///< scale of the picture at the vertex
  };
  /// #skin: the texture coordinate of each vertex of the skin.

  const std::vector<PictureVertex>& picture_vertices() const { return picture_vertices_; }

 private:
  void place_vertices(const ObjFile& file, const TextureLayout& layout);

  const WrapTemplate& shape_;
  std::vector<PictureName> names_;
  std::map<std::string, std::size_t> pictures_by_material_;
  std::vector<SurfaceTexels> texels_;
  MeshMaps maps_;
  std::vector<const FilteredTexture*> textures_;  ///< #pictures
  std::vector<std::uint32_t> skin_rows_;
  std::vector<PictureVertex> picture_vertices_;
  std::vector<std::string> warnings_;
};

}  // namespace crowdface
