// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/eye_socket.h"

#include <numeric>

#include <gtest/gtest.h>

#include "parts/scene.h"

namespace crowdface {
namespace {

/// Lids all around the front of a ball, some of them inside it.
struct Scene {
  Mesh mesh = testing::Shapes().ball({0, 0, 0}, 1.2, 24).mesh();
  Index ball = mesh.topology.vertex_count;
  Lids lids;
  Scene() {
    constexpr int kLids = 40;
    mesh.positions.conservativeResize(ball + kLids, 3);
    mesh.topology.vertex_count = ball + kLids;
    for (int i = 0; i < kLids; ++i) {
      const double turn = 0.157 * i;
      const Eigen::Vector3d direction =
          Eigen::Vector3d(0.9 * std::sin(turn), 0.45 * std::cos(turn), 0.8).normalized();
      mesh.positions.row(ball + i) = (1.2 + 0.01 * (i % 7 - 1)) * direction.transpose();
      lids.vertices.push_back(static_cast<std::uint32_t>(ball + i));
      lids.upper.push_back(direction.y() > 0);
    }
  }
  FacesAround faces{mesh.topology};

  Eyeball eyeball(const Positions& head) const {
    std::vector<std::uint32_t> vertices(static_cast<std::size_t>(ball));
    std::iota(vertices.begin(), vertices.end(), 0U);
    return {mesh.topology, faces, head, vertices, {0, 0, 0}, 1.2, lids};
  }
};

TEST(Eyeball, KnowsItsGapsWithTheirSigns) {
  const Scene scene;
  const Eyeball eyeball = scene.eyeball(scene.mesh.positions);
  for (std::size_t i = 0; i < eyeball.gaps().size(); ++i) {
    // The mesh of the ball lies up to 0.01 inside the ball.
    EXPECT_NEAR(eyeball.gaps()[i], 0.01 * (static_cast<double>(i % 7) - 1), 0.011);
  }
}

TEST(Eyeball, StaysWhereNothingMoved) {
  const Scene scene;
  const Eyeball eyeball = scene.eyeball(scene.mesh.positions);
  EXPECT_LT(eyeball.shift_into(scene.lids, {}, scene.mesh.positions).norm(), 1e-9);
}

TEST(Eyeball, IsShiftedUntilTheGapsAreBack) {
  const Scene scene;
  const Eyeball eyeball = scene.eyeball(scene.mesh.positions);
  const Eigen::RowVector3d away(0.02, -0.05, 0.15);
  Positions after = scene.mesh.positions;
  after.bottomRows(40).rowwise() += away;
  const Eigen::Vector3d shift = eyeball.shift_into(scene.lids, {}, after);
  // What a shift costs leaves a few per cent.
  EXPECT_LT((shift.transpose() - away).norm(), 0.05 * away.norm());
}

TEST(FindLids, TakesTheSkinNearestToTheAxis) {
  const Mesh mesh = testing::Shapes().ball({0, 0, 0}, 1.3, 24).ball({0, 0, 0}, 1.2, 24).mesh();
  const auto half = static_cast<std::uint32_t>(mesh.topology.vertex_count / 2);
  std::vector<std::uint32_t> skin(half), eyeball(half);
  std::iota(skin.begin(), skin.end(), 0U);
  std::iota(eyeball.begin(), eyeball.end(), half);
  const Lids lids =
      find_lids(mesh.positions, PointGrid(mesh.positions, eyeball), {0, 0, 0}, 1.2, {}, skin);
  // Without an opening all of it is around the axis.
  EXPECT_FALSE(lids.vertices.empty());
  EXPECT_LE(lids.vertices.size(), 48U);
  for (std::size_t i = 0; i < lids.vertices.size(); ++i) {
    EXPECT_LT(lids.vertices[i], half);
    EXPECT_GT(mesh.positions(lids.vertices[i], 2), 0.3 * 1.3);
    EXPECT_EQ(lids.upper[i], mesh.positions(lids.vertices[i], 1) > 0);
  }
}

}  // namespace
}  // namespace crowdface
