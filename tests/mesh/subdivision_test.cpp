// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/subdivision.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/mesh/adjacency.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::cube_positions;
using testing::cube_topology;
using testing::grid_topology;
using testing::make_topology;
using testing::random_positions;

TEST(Subdivide, CubeByHand) {
  const Mesh fine = subdivide({cube_topology(), cube_positions(), {}});
  ASSERT_EQ(fine.topology.vertex_count, 8 + 12 + 6);
  ASSERT_EQ(fine.topology.face_count(), 24);
  // Corner: (F + 2R) / 3 = (1/3 + 2 · 2/3) / 3; middle of an edge: (1 + 1/2 + …) in two axes.
  EXPECT_TRUE(fine.positions.topRows(8).isApprox(Positions(cube_positions() * 5 / 9), 1e-14));
  for (Index e = 8; e < 20; ++e)
    EXPECT_NEAR(fine.positions.row(e).norm(), 0.75 * std::sqrt(2), 1e-14);
  for (Index f = 20; f < 26; ++f) EXPECT_EQ(fine.positions.row(f).norm(), 1);
  EXPECT_EQ(find_components(build_adjacency(fine.topology)).count(), 1);
}

TEST(Subdivide, KeepsAFlatGridFlatAndItsRimStraight) {
  const Topology grid = grid_topology(3, 2);
  Positions flat(12, 3);
  for (Index i = 0; i < 12; ++i)
    flat.row(i) << static_cast<double>(i % 4), static_cast<double>(i / 4), 5;
  const Mesh fine = subdivide({grid, flat, {}});
  EXPECT_EQ(fine.topology.vertex_count, 12 + 17 + 6);
  EXPECT_TRUE((fine.positions.col(2).array() == 5).all());
  EXPECT_EQ(fine.positions.row(5), flat.row(5)) << "inside a regular grid nothing moves";
  EXPECT_EQ(fine.positions.row(1), flat.row(1)) << "nor on a straight rim";
  const Adjacency adjacency = build_adjacency(fine.topology);
  EXPECT_EQ(std::count(adjacency.boundary.begin(), adjacency.boundary.end(), true), 20);
}

TEST(Subdivide, IsLinearAndMovesWithTheMesh) {
  const Topology topology = make_topology(7, {{0, 1, 2}, {0, 2, 3, 4}, {4, 3, 5, 6, 0}});
  const Positions a = random_positions(7, 1), b = random_positions(7, 2);
  const Positions sum = subdivide({topology, 2 * a + 3 * b, {}}).positions;
  const Positions parts =
      2 * subdivide({topology, a, {}}).positions + 3 * subdivide({topology, b, {}}).positions;
  EXPECT_LT((sum - parts).cwiseAbs().maxCoeff(), 1e-13);
  const Positions moved = a.rowwise() + Eigen::RowVector3d(3, -1, 2);
  EXPECT_LT((subdivide({topology, moved, {}}).positions -
             (subdivide({topology, a, {}}).positions.rowwise() + Eigen::RowVector3d(3, -1, 2)))
                .cwiseAbs()
                .maxCoeff(),
            1e-13);
}

TEST(Subdivide, QuadsOfAFaceFollowItsCorners) {
  const Topology topology = make_topology(5, {{0, 1, 2}, {0, 2, 3, 4}});
  const Topology fine = subdivide({topology, random_positions(5, 1), {}}).topology;
  ASSERT_EQ(fine.face_count(), 7);
  for (std::size_t c = 0; c < 7; ++c) {
    EXPECT_EQ(fine.face(static_cast<Index>(c))[0], topology.corner_vertices[c]);
  }
}

TEST(Subdivide, SeamsOfTheTextureStaySeams) {
  // Two quads side by side whose textures lie apart.
  Topology topology = make_topology(6, {{0, 1, 4, 3}, {1, 2, 5, 4}});
  topology.corner_uvs = {0, 1, 2, 3, 4, 5, 6, 7};
  TextureCoordinates uvs(8, 2);
  uvs << 0, 0, 0.4, 0, 0.4, 1, 0, 1, 0.6, 0, 1, 0, 1, 1, 0.6, 1;
  const Mesh fine = subdivide({topology, random_positions(6, 3), uvs});
  ASSERT_EQ(fine.topology.corner_uvs.size(), fine.topology.corner_vertices.size());
  for (std::size_t c = 0; c < fine.topology.corner_uvs.size(); ++c) {
    const double u = fine.uvs(fine.topology.corner_uvs[c], 0);
    EXPECT_TRUE(c < 16 ? u <= 0.4 : u >= 0.6) << c;
  }
  EXPECT_EQ(fine.uvs.topRows(8), uvs);
}

TEST(SubdivisionRounds, ComesNearest) {
  const Topology cube = cube_topology();
  EXPECT_EQ(subdivision_rounds(cube, 8), 0);
  EXPECT_EQ(subdivision_rounds(cube, 14), 0);
  EXPECT_EQ(subdivision_rounds(cube, 15), 1);
  EXPECT_EQ(subdivision_rounds(cube, 98), 2);
  EXPECT_EQ(subdivision_rounds(cube, 1), 0);
}

}  // namespace
}  // namespace crowdface
