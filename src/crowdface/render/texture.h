// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/shading.h"

namespace crowdface {

/// A texture in linear light.
struct Texture {
  int width = 0;                  ///< in texels
  int height = 0;                 ///< in texels
  std::vector<LinearRgb> texels;  ///< height · width texels; the first row is the top, v = 1
};

/// Reads a texture row by row and reduces it by averaging whole blocks of texels, until no side is
/// longer than `max_px`.
/// \param row  writes the `width` texels of row y; called once for each row, from the top down.
Texture shrunk_texture(int width, int height, int max_px,
                       const std::function<void(int y, std::span<LinearRgb> texels)>& row);

/// Extends colours into unpainted texels, so that interpolation at the border of the painted area
/// does not mix in unpainted texels. In each step, an unpainted texel gets the mean of its painted
/// neighbours.
/// \param painted  whether each texel is painted
/// \param steps    number of steps: how far colours spread, in texels
void spread_colours(Texture& texture, std::vector<bool> painted, int steps);

/// The texture's colour, interpolated bilinearly between texel centres. The texture repeats in
/// every unit square of `uv`, but opposite edges are not interpolated with each other.
LinearRgb colour_at(const Texture& texture, const Eigen::Vector2f& uv);
/// The first channel of colour_at, for textures with one value per texel.
float value_at(const Texture& texture, const Eigen::Vector2f& uv);

/// A texture at decreasing resolutions, so that one lookup averages all texels behind a pixel.
struct MipMap {
  /// Level 0 is the texture; each further level has half the size, down to one texel on the
  /// shorter side.
  std::vector<Texture> levels;

  /// Computes all levels of a texture.
  explicit MipMap(Texture texture);
};

/// The textures of one head, and which polygon has which texture.
struct TextureLayer {
  static constexpr std::uint32_t kNone = 0xffffffffU;  ///< value in texture_of_polygon: no texture
  std::vector<std::shared_ptr<const Texture>> textures;  ///< all textures of the head
  /// for each polygon: index into `textures`, or kNone; if empty, no polygon has a texture
  std::vector<std::uint32_t> texture_of_polygon;
};

/// Colour textures, normal maps and roughness maps of one head. A polygon without a colour texture
/// (texture_of_polygon is kNone) has the default colour of its surface kind.
struct TextureSet : TextureLayer {
  /// Slopes of the surface along u and v, from tangent-space normal maps.
  TextureLayer slopes = {};
  TextureLayer roughness = {};  ///< the roughness is the first channel of each texture
};

}  // namespace crowdface
