// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/normals.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/triangles.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

TEST(VertexNormals, OfACubePointAlongItsDiagonals) {
  const Positions positions = testing::cube_positions();
  const Positions normals = vertex_normals(testing::cube_topology(), positions);
  EXPECT_LT((normals - positions / std::sqrt(3.0)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(FaceAreaVector, IsTwiceTheAreaWhereverTheFaceLies) {
  const Topology topology = testing::make_topology(4, {{0, 1, 2, 3}});
  Positions square(4, 3);
  square << 0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0;
  const Positions far = square.rowwise() + Eigen::RowVector3d(1e6, -1e6, 1e6);
  EXPECT_EQ(face_area_vector(topology, 0, square), Eigen::Vector3d(0, 0, 12));
  EXPECT_EQ(face_area_vector(topology, 0, far), Eigen::Vector3d(0, 0, 12));
}

TEST(VertexNormals, OfNothingPointForward) {
  const Positions normals =
      vertex_normals(testing::make_topology(4, {{0, 1, 2}}), Positions::Zero(4, 3));
  for (Index i = 0; i < 4; ++i) EXPECT_EQ(normals.row(i), Eigen::RowVector3d(0, 0, 1));
}

// Two functions of one name differed there.
TEST(VertexNormalsOrZero, AreZeroWhereThereIsNoNormal) {
  Positions positions = testing::cube_positions();
  const std::vector<Triangle> triangles = triangles_of(testing::cube_topology());
  const Positions normals = vertex_normals_or_zero(triangles, positions);
  EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  EXPECT_EQ(vertex_normals_or_zero(triangles, Positions::Zero(8, 3)), Positions::Zero(8, 3));
  EXPECT_EQ(vertex_normals_or_zero({}, positions), Positions::Zero(8, 3));
}

/// The normals face by face, scattered to the rows of its corners.
Positions scattered_normals(const Topology& topology, const std::vector<std::uint32_t>& rows,
                            Index count, const Positions& positions) {
  Positions normals = Positions::Zero(count, 3);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Eigen::RowVector3d area = face_area_vector(topology, f, positions);
    for (auto c = topology.face_offsets[static_cast<std::size_t>(f)];
         c < topology.face_offsets[static_cast<std::size_t>(f) + 1]; ++c) {
      if (rows[c] != kNoIndex) normals.row(rows[c]) += area;
    }
  }
  for (Index i = 0; i < count; ++i) {
    const double x = normals(i, 0), y = normals(i, 1), z = normals(i, 2);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length > 0) normals.row(i) /= length;
  }
  return normals;
}

TEST(VertexNormals, HaveTheSameBitsForAnyNumberOfThreads) {
  const Topology topology = testing::grid_topology(150, 120);  // several blocks
  const Positions positions = testing::random_positions(topology.vertex_count, 3);
  const Positions expected =
      scattered_normals(topology, topology.corner_vertices, topology.vertex_count, positions);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(vertex_normals(topology, positions), expected) << threads << " threads";
  }
}

TEST(NormalFans, FollowTheRowsOfTheCorners) {
  const Topology topology = testing::cube_topology();
  std::vector<std::uint32_t> rows;  // each face its own normal, the last one none; row 6 is unused
  for (std::uint32_t c = 0; c < 24; ++c) rows.push_back(c / 4 == 5 ? kNoIndex : c / 4);
  const Positions positions = testing::random_positions(8, 4);
  const NormalFans fans(topology, rows, 7);
  const Positions normals = fans.normals(topology, positions, {0, 0, 0});
  EXPECT_EQ(normals, scattered_normals(topology, rows, 7, positions));
  EXPECT_EQ(normals.row(6), Eigen::RowVector3d(0, 0, 0));
}

}  // namespace
}  // namespace crowdface
