// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/vertex_roughness.h"

#include <algorithm>

namespace crowdface {
namespace {

/// Returns the texture of the polygon `place.face`; null if this polygon has no texture in `layer`.
const Texture* picture_at(const TextureLayer& layer, const TexturePoint& place) {
  if (place.face < 0 || layer.texture_of_polygon.empty()) return nullptr;
  const std::uint32_t picture = layer.texture_of_polygon[static_cast<std::size_t>(place.face)];
  return picture == TextureLayer::kNone ? nullptr : layer.textures[picture].get();
}

/// Mean of 3 by 3 samples around a point. The outer samples are 1/512 of the texture's side away in
/// each direction.
LinearRgb mean_around(const Texture& texture, const Eigen::Vector2f& uv) {
  constexpr float kReach = 1.0F / 512;
  LinearRgb sum = LinearRgb::Zero();
  for (const float x : {-kReach, 0.0F, kReach}) {
    for (const float y : {-kReach, 0.0F, kReach}) {
      sum += colour_at(texture, uv + Eigen::Vector2f(x, y));
    }
  }
  return sum / 9;
}

}  // namespace

std::optional<float> roughness_at(const TextureSet& texture_set, const TexturePoint& place) {
  const Texture* roughness = picture_at(texture_set.roughness, place);
  if (roughness == nullptr) return std::nullopt;
  return std::clamp(mean_around(*roughness, place.uv)[0], 0.0F, 1.0F);
}

}  // namespace crowdface
