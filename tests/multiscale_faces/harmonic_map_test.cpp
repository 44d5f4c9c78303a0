// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/harmonic_map.h"

#include <set>

#include <gtest/gtest.h>

#include "multiscale_faces/heads_under_test.h"

namespace crowdface::multiscale {
namespace {

TEST(FrontPatch, IsOneSurfaceWithABorderAndHoles) {
  const TestHeads heads;
  const FrontPatch& patch = heads.patch;
  EXPECT_GT(patch.vertex_count(), heads.topology.vertex_count / 4);
  // Euler's formula for a disk with holes: V − E + F = 1 − holes.
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : patch.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  }
  EXPECT_EQ(patch.vertex_count() - static_cast<Index>(edges.size()) +
                static_cast<Index>(patch.triangles.size()),
            1 - static_cast<Index>(patch.hole_rims.size()));
}

TEST(HarmonicMap, FillsTheSquareWithoutFolds) {
  const TestHeads heads;
  for (const Positions& front : heads.fronts) {
    const TextureCoordinates uvs = harmonic_map(heads.patch, front);
    EXPECT_EQ(uvs.minCoeff(), 0);
    EXPECT_EQ(uvs.maxCoeff(), 1);
    double area = 0;
    std::size_t flat = 0;
    for (const Triangle& t : heads.patch.triangles) {
      const Eigen::RowVector2d a = uvs.row(t[1]) - uvs.row(t[0]), b = uvs.row(t[2]) - uvs.row(t[0]);
      const double twice = a[0] * b[1] - a[1] * b[0];
      EXPECT_GT(twice, -1e-15);
      flat += twice < 1e-15 ? 1 : 0;
      area += twice / 2;
    }
    // Parts that hang on the rest by two vertices become flat.
    EXPECT_LT(flat, heads.patch.triangles.size() / 200);
    EXPECT_LE(area, 1 + 1e-9);
    EXPECT_GT(area, 0.9);  // the holes are small
  }
}

}  // namespace
}  // namespace crowdface::multiscale
