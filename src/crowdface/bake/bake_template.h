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

/// The texture layout and the colours of a template. One object serves any number of bakes.
///
/// A picture is an image to bake. There is one picture for each texture file that the template's
/// skin uses. Untextured skin has one picture for each pair of material and UDIM tile.
class BakeTemplate {
 public:
  /// \param file, wrap_template  the file and the shape of the template; must outlive this object.
  /// \param picture_side  width and height of each picture, in texels.
  /// \throws InvalidInput if the skin has no texture coordinates.
  BakeTemplate(const ObjFile& file, const WrapTemplate& wrap_template, int picture_side);

  const WrapTemplate& wrap_template() const { return wrap_template_; }
  /// The name of each picture.
  const std::vector<PictureName>& picture_names() const { return picture_names_; }
  /// For each baked material, the index of a picture that shows this material.
  const std::map<std::string, std::size_t>& pictures_by_material() const {
    return pictures_by_material_;
  }
  /// For each texel of a picture: the triangle that covers the texel.
  const SurfaceTexels& texels(std::size_t picture) const { return texels_[picture]; }
  /// The template's own texture that corresponds to a picture; nullptr if there is none.
  const FilteredTexture* texture(std::size_t picture) const { return textures_[picture]; }
  /// Messages about missing or unreadable files of the template.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The value of skin_rows() for vertices outside the skin.
  static constexpr std::uint32_t kNotSkin = kNoIndex;
  /// For each vertex of the template: its row in the arrays of skin vertices, or kNotSkin.
  const std::vector<std::uint32_t>& skin_rows() const { return skin_rows_; }

  /// A picture that shows a vertex, and the vertex's texture coordinates in this picture.
  struct PictureVertex {
    /// index of the picture; kNoIndex if no picture shows the vertex
    std::uint32_t picture = kNoIndex;
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    /// length in texture space that corresponds to one millimetre of skin at the vertex
    double uv_per_mm = 0;
  };
  /// For each vertex of the skin: where a picture shows the vertex.
  const std::vector<PictureVertex>& picture_vertices() const { return picture_vertices_; }

 private:
  /// Finds, for each skin vertex, a picture (texture image) that shows the vertex, and the vertex's
  /// position in this picture: fills picture_vertices_.
  void find_picture_vertices(const ObjFile& file, const TextureLayout& layout);

  const WrapTemplate& wrap_template_;
  std::vector<PictureName> picture_names_;  ///< the name of each picture
  /// for each baked material, the index of a picture that shows the material
  std::map<std::string, std::size_t> pictures_by_material_;
  std::vector<SurfaceTexels> texels_;  ///< for each picture: the triangle that covers each texel
  MeshMaps maps_;                      ///< the template's colour textures
  std::vector<const FilteredTexture*> textures_;  ///< for each picture: the result of `texture()`
  std::vector<std::uint32_t> skin_rows_;          ///< result of `skin_rows()`
  std::vector<PictureVertex> picture_vertices_;   ///< result of `picture_vertices()`
  std::vector<std::string> warnings_;
};

}  // namespace crowdface
