// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/vertex_finish.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

/// The texture of `layer` that covers the vertex at `place`; null if none covers the vertex.
const Texture* picture_at(const TextureLayer& layer, const TexturePlace& place) {
  if (place.face < 0 || layer.texture_of_face.empty()) return nullptr;
  const std::uint32_t picture = layer.texture_of_face[static_cast<std::size_t>(place.face)];
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

Vector3d tilted_normal(const TextureSet& texture_set, const Topology& topology,
                       const TextureCoordinates& coordinates, const TexturePlace& place,
                       const Positions& positions, const Vector3d& normal) {
  const Texture* slopes = picture_at(texture_set.slopes, place);
  if (slopes == nullptr) return normal;
  // Derive the texture axes from the triangle at the polygon's first corner.
  const auto vertices = topology.face(place.face);
  const auto uvs = topology.face_uvs(place.face);
  const std::size_t last = vertices.size() - 1;
  if (std::ranges::find(uvs, kNoIndex) != uvs.end()) return normal;
  const Vector3d origin = row3(positions, vertices[0]);
  const Vector3d one = row3(positions, vertices[1]) - origin;
  const Vector3d other = row3(positions, vertices[last]) - origin;
  const Eigen::Vector2d uv_one = (coordinates.row(uvs[1]) - coordinates.row(uvs[0])).transpose();
  const Eigen::Vector2d uv_other =
      (coordinates.row(uvs[last]) - coordinates.row(uvs[0])).transpose();
  const double area = uv_one.x() * uv_other.y() - uv_other.x() * uv_one.y();
  if (area == 0) return normal;
  const double sign = area > 0 ? 1 : -1;
  const auto along = [&](const Vector3d& axis) -> Vector3d {
    const Vector3d flat = axis - axis.dot(normal) * normal;
    const double length = flat.norm();
    return length > 0 ? Vector3d(sign / length * flat) : Vector3d(Vector3d::Zero());
  };
  const LinearRgb lean = mean_around(*slopes, place.uv);
  return (normal + double{lean[0]} * along(uv_other.y() * one - uv_one.y() * other) +
          double{lean[1]} * along(uv_one.x() * other - uv_other.x() * one))
      .normalized();
}

std::optional<float> roughness_at(const TextureSet& texture_set, const TexturePlace& place) {
  const Texture* roughness = picture_at(texture_set.roughness, place);
  if (roughness == nullptr) return std::nullopt;
  return std::clamp(mean_around(*roughness, place.uv)[0], 0.0F, 1.0F);
}

}  // namespace crowdface
