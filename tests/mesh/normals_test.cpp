// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/normals.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace crowdface
