// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/visibility.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/winding.h"
#include "crowdface/render/camera_space.h"
#include "crowdface/render/perpendicular.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/render/sampling_pattern.h"

namespace crowdface {
namespace {

using Vector = Eigen::Vector3f;

constexpr int kRays = 64;  // per vertex
constexpr std::size_t kVerticesPerBlock = 64;
// Length of the visibility rays, and the distance of their origins from the surface, both as
// fractions of the head's largest extent.
constexpr float kReach = 0.3F;
constexpr float kClearance = 5e-4F;

}  // namespace

std::vector<float> vertex_visibility(const Topology& topology,
                                     const std::vector<SurfaceKind>& kinds,
                                     const Positions& positions,
                                     std::span<const std::uint32_t> vertices) {
  require(kinds.empty() || static_cast<Index>(kinds.size()) == topology.face_count(),
          "visibility: ", kinds.size(), " surface kinds, expected ", topology.face_count(),
          ", one per polygon");
  const Eigen::RowVector3d low = positions.colwise().minCoeff();
  const double size = std::max((positions.colwise().maxCoeff() - low).maxCoeff(), 1e-300);
  std::vector<float> points;
  for (Index v = 0; v < positions.rows(); ++v) {
    const Vector point = ((positions.row(v) - low) / size).cast<float>().transpose();
    points.insert(points.end(), {point.x(), point.y(), point.z()});
  }
  std::vector<Quad> triangles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (!kinds.empty() && kinds[static_cast<std::size_t>(f)] == SurfaceKind::kHidden) continue;
    const auto face = topology.face(f);
    for (std::size_t c = 1; c + 1 < face.size(); ++c) {
      triangles.push_back({face[0], face[c], face[c + 1], face[c + 1]});
    }
  }
  const std::vector<Vector> normals =
      camera_normals(topology, NormalFans(topology), points, winding_sign(topology, positions));
  const RayDevice device;
  const RayScene scene(device, std::move(points), triangles);
  const InterleavedDisc disc(kRays);
  std::vector<float> open(vertices.size());
  parallel_blocks(vertices.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<Ray> rays;
    for (std::size_t v = begin; v < end; ++v) {
      const Vector& normal = normals[vertices[v]];
      const auto [s, t] = tangent_basis(normal);
      const Vector start = scene.point(vertices[v]) + kClearance * normal;
      for (int k = 0; k < kRays; ++k) {
        const Eigen::Vector2f& place = disc.point(0, 0, k);
        const float height = std::sqrt(std::max(0.0F, 1 - place.squaredNorm()));
        rays.push_back({start, place.x() * s + place.y() * t + height * normal, 0, kReach});
      }
    }
    const std::vector<bool> blocked = scene.occluded(rays);
    for (std::size_t v = begin; v < end; ++v) {
      const auto first = blocked.begin() + static_cast<std::ptrdiff_t>((v - begin) * kRays);
      open[v] = static_cast<float>(std::count(first, first + kRays, false)) / kRays;
    }
  });
  return open;
}

}  // namespace crowdface
