// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/visibility.h"

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

#include "render/shapes.h"

namespace crowdface {
namespace {

TEST(Visibility, IsWholeOnABallAndNoneInsideAnother) {
  const Mesh outer = make_sphere(10), inner = make_sphere(9);
  const Mesh both = join_meshes(outer, inner, Eigen::RowVector3d::Zero());
  const auto inside = static_cast<std::uint32_t>(outer.topology.vertex_count) + 30;
  const std::vector<std::uint32_t> vertices = {30, inside};
  const auto open = vertex_visibility(both.topology, {}, both.positions, vertices);
  EXPECT_GT(open[0], 0.98F);
  EXPECT_EQ(open[1], 0);
  std::vector<SurfaceKind> kinds(static_cast<std::size_t>(both.topology.face_count()),
                                 SurfaceKind::kSkin);
  std::fill_n(kinds.begin(), outer.topology.face_count(), SurfaceKind::kHidden);
  EXPECT_GT(vertex_visibility(both.topology, kinds, both.positions, vertices)[1], 0.98F)
      << "what is not shown hides nothing";
}

TEST(Visibility, IsTheSameInsideOut) {
  const Mesh ball = make_sphere(10);
  const Positions mirrored = ball.positions * Eigen::Vector3d(-1, 1, 1).asDiagonal();
  const std::vector<std::uint32_t> vertices = {30, 40};
  for (const float open : vertex_visibility(ball.topology, {}, mirrored, vertices)) {
    EXPECT_GT(open, 0.98F);
  }
  EXPECT_THROW(vertex_visibility(ball.topology, {SurfaceKind::kSkin}, ball.positions, vertices),
               BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
