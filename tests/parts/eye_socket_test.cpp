// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/eye_socket.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/parts/surface_point.h"

#include "parts/scene.h"

namespace crowdface {
namespace {

constexpr int kLids = 40;
constexpr double kRadius = 1.2;

/// Lids all around the front of a ball, some of them inside it.
struct LidsAroundBall {
  Mesh mesh = testing::Shapes().ball({0, 0, 0}, kRadius, 24).mesh();
  Index ball = mesh.topology.vertex_count;
  Lids lids;
  LidsAroundBall() {
    mesh.positions.conservativeResize(ball + kLids, 3);
    mesh.topology.vertex_count = ball + kLids;
    for (int i = 0; i < kLids; ++i) {
      const double turn = 0.157 * i;
      const Eigen::Vector3d direction =
          Eigen::Vector3d(0.9 * std::sin(turn), 0.45 * std::cos(turn), 0.8).normalized();
      mesh.positions.row(ball + i) = (kRadius + gap(i)) * direction.transpose();
      lids.vertices.push_back(static_cast<std::uint32_t>(ball + i));
      lids.rim.push_back(static_cast<std::uint32_t>(i));
      lids.is_upper.push_back(direction.y() > 0);
    }
  }
  /// One in seven is inside.
  static double gap(int i) { return 0.02 * (i % 7 == 0 ? -1 : i % 7); }

  VertexFaces faces{mesh.topology};
  std::vector<std::uint32_t> surface() const {
    std::vector<std::uint32_t> vertices(static_cast<std::size_t>(ball));
    std::iota(vertices.begin(), vertices.end(), 0U);
    return vertices;
  }
  EyeSocket socket() const {
    return {lids,
            {BallRadii(mesh.topology, faces, mesh.positions, surface(), {0, 0, 0}, kRadius, {})},
            {{"ann", mesh.positions}}};
  }
  Positions lids_moved(const Eigen::RowVector3d& by) const {
    Positions after = mesh.positions;
    after.bottomRows(kLids).rowwise() += by;
    return after;
  }
  /// Gaps after a motion, by search on the moved ball itself.
  std::vector<double> gaps_after(const RigidMotion& motion, const Positions& after) const {
    Positions moved = after;
    for (Index v = 0; v < ball; ++v) {
      moved.row(v) = motion.apply(mesh.positions.row(v).transpose()).transpose();
    }
    const PointGrid grid(moved, surface());
    std::vector<double> gaps;
    for (Index v = ball; v < moved.rows(); ++v) {
      const Eigen::Vector3d point = moved.row(v).transpose();
      const SurfacePoint place =
          nearest_point_around(mesh.topology, faces, moved, grid.nearest(point).vertex, point);
      const Eigen::Vector3d centre = motion.apply({0, 0, 0});
      const bool inside = (point - centre).norm() < (place.position - centre).norm();
      gaps.push_back(inside ? -place.distance : place.distance);
    }
    return gaps;
  }
};

TEST(BallMap, KnowsGapsAndWhichWayTheyOpen) {
  const LidsAroundBall scene;
  const BallRadii map(scene.mesh.topology, scene.faces, scene.mesh.positions, scene.surface(),
                      {0, 0, 0}, kRadius, {});
  for (int i = 0; i < kLids; ++i) {
    const Eigen::Vector3d point = scene.mesh.positions.row(scene.ball + i).transpose();
    const BallRadii::Gap gap = map.gap_at(point);
    // The mesh of the ball lies up to 0.01 inside the ball.
    EXPECT_NEAR(gap.gap, LidsAroundBall::gap(i), 0.011);
    EXPECT_GT(gap.normal.dot(point.normalized()), 0.98);
  }
}

TEST(BallMap, FollowsACornea) {
  LidsAroundBall scene;
  for (Index v = 0; v < scene.ball; ++v) {  // a bulge at the front
    const double off = std::max(0.0, scene.mesh.positions(v, 2) - 1);
    scene.mesh.positions(v, 2) += 0.5 * off;
  }
  const BallRadii map(scene.mesh.topology, scene.faces, scene.mesh.positions, scene.surface(),
                      {0, 0, 0}, kRadius, {});
  const std::vector<double> expected = scene.gaps_after({}, scene.mesh.positions);
  for (int i = 0; i < kLids; ++i) {
    const Eigen::Vector3d point = scene.mesh.positions.row(scene.ball + i).transpose();
    EXPECT_NEAR(map.gap_at(point).gap, expected[static_cast<std::size_t>(i)], 0.005);
  }
}

TEST(EyeSocket, LeavesTheEyeballWhereNothingMoved) {
  const LidsAroundBall scene;
  const RigidMotion motion = scene.socket().fit(0, {}, scene.mesh.positions);
  EXPECT_LT(motion.moved_pivot.norm(), 1e-9);
  EXPECT_NEAR(motion.scale, 1, 1e-9);
}

TEST(EyeSocket, ShiftsTheEyeballUntilTheGapsAreBack) {
  const LidsAroundBall scene;
  const Eigen::RowVector3d away(0.02, -0.05, 0.15);
  const RigidMotion motion = scene.socket().fit(0, {}, scene.lids_moved(away));
  // What a shift costs leaves a few per cent.
  EXPECT_LT((motion.moved_pivot.transpose() - away).norm(), 0.1 * away.norm());
}

TEST(EyeSocket, LetsNoLidInThatIsInsideInNoHead) {
  const LidsAroundBall scene;
  Positions after = scene.mesh.positions;
  for (int i = 0; i < kLids; ++i) {  // pressed in at the corners, lifted in the middle
    const double x = after(scene.ball + i, 0);
    after.row(scene.ball + i) *= 1.03 - 0.12 * x * x;
  }
  const auto count_new = [&](const RigidMotion& motion) {
    const std::vector<double> gaps = scene.gaps_after(motion, after);
    int count = 0;
    for (int i = 0; i < kLids; ++i) {
      count += LidsAroundBall::gap(i) > 0 && gaps[static_cast<std::size_t>(i)] < -0.002 ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(count_new({}), 5);
  const RigidMotion motion = scene.socket().fit(0, {}, after);
  EXPECT_EQ(count_new(motion), 0);
  const std::vector<double> before = scene.gaps_after({}, scene.mesh.positions);
  const std::vector<double> gaps = scene.gaps_after(motion, after);
  for (const bool upper : {false, true}) {
    double change = 0, count = 0;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      if (scene.lids.is_upper[i] != upper) continue;
      change += gaps[i] - before[i];
      count += 1;
    }
    EXPECT_NEAR(change / count, 0, 0.02) << "the mean gap stays, by 0.2 mm";
  }
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
  EXPECT_FALSE(lids.rim.empty());
  EXPECT_LE(lids.rim.size(), 60U);
  EXPECT_GT(lids.vertices.size(), half / 2);
  for (std::size_t i = 0; i < lids.rim.size(); ++i) {
    const std::uint32_t v = lids.vertices[lids.rim[i]];
    EXPECT_LT(v, half);
    EXPECT_GT(mesh.positions(v, 2), 0.3 * 1.3);
    EXPECT_EQ(lids.is_upper[i], mesh.positions(v, 1) > 0);
  }
}

}  // namespace
}  // namespace crowdface
