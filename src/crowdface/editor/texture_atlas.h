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
/// uses a single texture at a time. The layout is the same for all heads.
class TextureAtlas {
 public:
  /// \param inputs  must outlive this object
  explicit TextureAtlas(const Inputs& inputs);

  /// The heads' texture coordinates converted to atlas coordinates, #uvs by 2.
  TextureCoordinates coordinates() const;
  bool has(Index head) const;
  /// Converts atlas coordinates to coordinates in a cell. Only the fractional parts of the result
  /// are meaningful.
  Eigen::Vector2f cell_coordinates(const Eigen::Vector2f& uv) const {
    return {uv.x() * static_cast<float>(columns_), uv.y() * static_cast<float>(rows_)};
  }
  /// Whether the atlas contains the texture of a polygon.
  bool shows(std::uint32_t face) const {
    return !cell_of_face_.empty() && cell_of_face_[face] != TextureLayer::kNone;
  }
  /// The atlas with a head's colour textures, as a JPEG file; nothing if the head has no texture.
  std::optional<std::string> picture(Index head) const;
  /// Returns the atlas with these colour textures, as a JPEG file.
  std::string colours(const TextureLayer& layer) const;
  /// Converts slopes to a tangent-space normal map with y upwards, in the layout of the atlas.
  /// Returns a JPEG file.
  std::string normals(const TextureLayer& slopes) const;

 private:
  using Texel = std::array<std::uint8_t, 3>;
  std::string encoded(const TextureLayer& layer, const Light& elsewhere,
                      Texel (*texel_of)(const Light&)) const;

  const Inputs& inputs_;
  /// for each polygon: index of the cell, or TextureLayer::kNone; empty: no head has textures
  std::vector<std::uint32_t> cell_of_face_;
  std::uint32_t cells_ = 0;
  int columns_ = 1, rows_ = 1, cell_px_ = 0;
};

}  // namespace crowdface
