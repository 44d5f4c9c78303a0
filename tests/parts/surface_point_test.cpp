// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/surface_point.h"

#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

#include "parts/scene.h"

namespace crowdface {
namespace {

Eigen::Vector3d random_point(std::uint64_t i, double reach) {
  Eigen::Vector3d point;
  for (std::uint64_t c = 0; c < 3; ++c) {
    point(static_cast<Index>(c)) = reach * random_normal({5, i, c == 0 ? "x" : c == 1 ? "y" : "z"});
  }
  return point;
}

TEST(PointGrid, FindsTheNearestOfAll) {
  const Positions points = testing::Shapes().ball({1, 2, 3}, 4, 10).mesh().positions;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < points.rows(); v += 2) vertices.push_back(v);
  const PointGrid grid(points, vertices);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Eigen::Vector3d point = random_point(i, i % 3 == 0 ? 40 : 4);
    double best = 1e300;
    for (const std::uint32_t v : vertices) {
      best = std::min(best, (points.row(v).transpose() - point).norm());
    }
    const auto found = grid.nearest(point);
    EXPECT_NEAR(found.distance, best, 1e-12);
    EXPECT_NEAR((points.row(found.vertex).transpose() - point).norm(), best, 1e-12);
    EXPECT_EQ(grid.nearest(point, 0.5 * best).vertex, kNoIndex);
  }
}

TEST(SurfacePoint, IsNearerThanAnyOtherPlaceOnItsTriangles) {
  const Mesh mesh = testing::Shapes().ball({0, 0, 0}, 5, 8).mesh();
  const VertexFaces faces(mesh.topology);
  std::vector<std::uint32_t> all(static_cast<std::size_t>(mesh.topology.vertex_count));
  std::iota(all.begin(), all.end(), 0U);
  const PointGrid grid(mesh.positions, all);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Eigen::Vector3d point = random_point(i, 4);
    const SurfacePoint place = nearest_point_around(mesh.topology, faces, mesh.positions,
                                                    grid.nearest(point).vertex, point);
    EXPECT_NEAR(place.barycentric[0] + place.barycentric[1] + place.barycentric[2], 1, 1e-12);
    EXPECT_NEAR((place.position - point).norm(), place.distance, 1e-12);
    // Every triangle of the mesh, sampled finely.
    double best = 1e300;
    for (Index f = 0; f < mesh.topology.face_count(); ++f) {
      const auto face = mesh.topology.face(f);
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        for (int a = 0; a <= 12; ++a) {
          for (int b = 0; a + b <= 12; ++b) {
            const Eigen::RowVector3d sample =
                (a * mesh.positions.row(face[0]) + b * mesh.positions.row(face[k]) +
                 (12 - a - b) * mesh.positions.row(face[k + 1])) /
                12;
            best = std::min(best, (sample.transpose() - point).norm());
          }
        }
      }
    }
    EXPECT_LE(place.distance, best + 1e-12) << i;
    EXPECT_GT(place.distance, best - 0.3) << i;
  }
}

}  // namespace
}  // namespace crowdface
