// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/texture.h"

namespace crowdface {

/// Where a vertex of a reduced mesh lies in a face's texture.
struct TexturePlace {
  Index face = -1;  ///< of the whole mesh, at the vertex; −1: it is in no texture
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
};

/// The normal at a vertex, leaning as a coat's map says on average around it: what is finer than a reduced mesh
/// would be grain there. \param positions  #V by 3 of the face
Eigen::Vector3d leaning_normal(const TextureCoat& coat, const FaceSet& faces,
                               const TexturePlace& place, const Positions& positions,
                               const Eigen::Vector3d& normal);

/// A coat's roughness there, 0 … 1; nothing where it has none.
std::optional<float> roughness_at(const TextureCoat& coat, const TexturePlace& place);

}  // namespace crowdface
