// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
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

/// A texture made smaller, texels averaged in whole blocks, until no side is longer.
Texture shrunk(Texture texture, int most_px);

/// The colour at texture coordinates: bilinear between the centres of texels, clamped at the edge.
/// Only what lies behind the point of a coordinate counts, so that each tile holds one picture.
Light colour_at(const Texture& texture, const Eigen::Vector2f& uv);

/// What colours the faces of one head.
struct TextureCoat {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<std::uint32_t>
      of_face;  ///< #F rows of `textures`, or kNone: the surface's own colour
};

}  // namespace crowdface
