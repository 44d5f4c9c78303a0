// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The textures of all materials and UDIM tiles of a head, combined in one image, because the page
/// uses a single texture at a time. Each texture has one cell of a grid. The layout is the same
/// for all heads.
class TextureAtlas {
 public:
  /// \param inputs  must outlive this object
  explicit TextureAtlas(const Inputs& inputs);

  /// The heads' texture coordinates converted to atlas coordinates, #uvs by 2.
  TextureCoordinates coordinates() const;
  bool has_textures_of(Index head) const;
  /// Scales atlas coordinates so that each cell of the atlas is a unit square. The fractional parts
  /// of the result are the texture coordinates within the cell.
  Eigen::Vector2f cell_coordinates(const Eigen::Vector2f& uv) const {
    return {uv.x() * static_cast<float>(columns_), uv.y() * static_cast<float>(rows_)};
  }
  /// Whether the atlas contains the texture of a polygon.
  bool covers_polygon(std::uint32_t polygon) const {
    return !cell_of_polygon_.empty() && cell_of_polygon_[polygon] != TextureLayer::kNone;
  }
  /// Returns the atlas of a head's colour textures, as a JPEG file; nothing if the head has no
  /// texture.
  std::optional<std::string> head_jpeg(Index head) const;
  /// Arranges the colour textures of a layer in the atlas. Returns a JPEG file.
  std::string colour_jpeg(const TextureLayer& layer) const;
  /// Converts slopes to a tangent-space normal map with y upwards, in the layout of the atlas.
  /// Returns a JPEG file.
  std::string normal_map_jpeg(const TextureLayer& slopes) const;

 private:
  using Texel = std::array<std::uint8_t, 3>;
  /// Arranges the textures of a layer in the atlas, and encodes the atlas as a JPEG file.
  /// \param default_colour  fills the cells that have no texture
  /// \param texel_of        converts a value of the layer to the bytes of a texel
  std::string to_jpeg(const TextureLayer& layer, const LinearRgb& default_colour,
                      Texel (*texel_of)(const LinearRgb&)) const;

  const Inputs& inputs_;
  /// For each polygon: index of the cell with the polygon's texture, or TextureLayer::kNone. Empty:
  /// no head has textures.
  std::vector<std::uint32_t> cell_of_polygon_;
  std::uint32_t cell_count_ = 0;  ///< number of cells with textures, one for each texture of a head
  int columns_ = 1, rows_ = 1;    ///< number of columns and rows of cells
  int cell_px_ = 0;               ///< width and height of a cell, in texels
};

}  // namespace crowdface
