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
  /// Converts atlas coordinates to coordinates in a cell; only the fractional parts count.
  Eigen::Vector2f cell_coordinates(const Eigen::Vector2f& uv) const {
    return {uv.x() * static_cast<float>(columns_), uv.y() * static_cast<float>(rows_)};
  }
  /// Whether the texture of a polygon is in the atlas.
  bool shows(std::uint32_t face) const {
    return !cell_of_face_.empty() && cell_of_face_[face] != TextureLayer::kNone;
  }
  /// The atlas of a head as a JPEG file; nothing if the head has no texture.
  std::optional<std::string> picture(Index head) const;
  /// Colour textures as a JPEG file of the atlas.
  std::string colours(const TextureLayer& layer) const;
  /// Slopes as a JPEG file of the atlas: a tangent-space normal map, y upwards.
  std::string normals(const TextureLayer& slopes) const;

 private:
  using Texel = std::array<std::uint8_t, 3>;
  std::string encoded(const TextureLayer& layer, const Light& elsewhere,
                      Texel (*texel_of)(const Light&)) const;

  const Inputs& inputs_;
  std::vector<std::uint32_t> cell_of_face_;  ///< or TextureSet::kNone; empty: no head has textures
  std::uint32_t cells_ = 0;
  int columns_ = 1, rows_ = 1, cell_px_ = 0;
};

}  // namespace crowdface
