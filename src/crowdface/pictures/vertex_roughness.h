// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/texture.h"

namespace crowdface {

/// A position in the textures of the full mesh (before reduction).
struct TexturePoint {
  /// The polygon, of the full mesh, in whose texture the position lies; −1: there is no texture.
  Index face = -1;
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();  ///< texture coordinates of the position
};

/// The roughness map's value at a vertex, 0 … 1; nothing if there is no roughness map. The map is
/// averaged around the vertex, because detail finer than the reduced mesh would appear as noise.
std::optional<float> roughness_at(const TextureSet& texture_set, const TexturePoint& place);

}  // namespace crowdface
