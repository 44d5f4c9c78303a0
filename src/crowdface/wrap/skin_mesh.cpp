// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/skin_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/render/ray_scene.h"

namespace crowdface {
namespace {

constexpr int kRays = 48;

/// Evenly distributed directions on the sphere: a golden-angle spiral.
std::array<Eigen::Vector3f, kRays> directions() {
  constexpr double kGoldenAngle = 2.39996322972865332;
  std::array<Eigen::Vector3f, kRays> all;
  for (int i = 0; i < kRays; ++i) {
    const double z = 1 - (2 * i + 1.0) / kRays, r = std::sqrt(1 - z * z);
    all[static_cast<std::size_t>(i)] = {static_cast<float>(r * std::cos(kGoldenAngle * i)),
                                        static_cast<float>(r * std::sin(kGoldenAngle * i)),
                                        static_cast<float>(z)};
  }
  return all;
}

}  // namespace

Positions SkinMesh::rows_of(const Positions& positions) const {
  return positions(vertices, kAllColumns);
}

std::vector<double> vertex_ambient_visibility(const Positions& positions, const Positions& normals,
                                              const std::vector<Triangle>& triangles,
                                              const std::vector<std::uint32_t>& vertices) {
  const std::vector<Quad> quads = quads_of(triangles);
  const RayDevice device;
  const RayScene scene(device, points_around(positions, Eigen::Vector3d::Zero()), quads);
  const auto rays = directions();
  std::vector<double> open(vertices.size());
  parallel_for_each(vertices.size(), 256, [&](std::size_t i) {
    const std::uint32_t v = vertices[i];
    const Eigen::Vector3f normal = row3(normals, v).cast<float>();
    const Eigen::Vector3f from = row3(positions, v).cast<float>() + 0.05F * normal;
    std::vector<Ray> outward;
    for (const Eigen::Vector3f& ray : rays) {
      if (ray.dot(normal) >= 0.1F) outward.push_back({from, ray, 0.01F});
    }
    const std::vector<bool> blocked = scene.occluded(outward);
    const auto free = static_cast<double>(std::count(blocked.begin(), blocked.end(), false));
    open[i] = outward.empty() ? 0 : free / static_cast<double>(outward.size());
  });
  return open;
}

}  // namespace crowdface
