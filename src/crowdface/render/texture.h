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

/// A picture that colours a surface, in linear light.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<Light> texels;  ///< height · width, first row on top: v = 1
};

/// A texture made smaller while it is read, texels averaged in whole blocks, until no side is longer.
/// \param row  writes the `width` texels of row y; each row is asked for once, from the top down.
Texture shrunk_texture(int width, int height, int most_px,
                       const std::function<void(int y, std::span<Light> texels)>& row);

/// Gives texels that have no colour the mean of those beside them that have one, from the border of
/// these outwards, so that between texels nothing is mixed with what was never painted.
/// \param painted  #texels
/// \param steps    how far, in texels
void spread_colours(Texture& texture, std::vector<bool> painted, int steps);

/// The colour, or whatever else it holds, at texture coordinates: bilinear between the centres of texels, clamped at the edge.
/// Only what lies behind the point of a coordinate counts, so that each tile holds one picture.
Light colour_at(const Texture& texture, const Eigen::Vector2f& uv);

/// Pictures on the faces of one head.
struct TextureLayer {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<std::uint32_t> of_face;  ///< #F rows of `textures`, or kNone; empty: no face has any
};

/// What colours the faces of one head, where a face has kNone its surface does itself; and how they reflect.
struct TextureCoat : TextureLayer {
  TextureLayer slopes = {};     ///< of tangent-space normals, to the right and upwards
  TextureLayer roughness = {};  ///< in the first channel
};

}  // namespace crowdface
