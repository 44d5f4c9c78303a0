// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/rigid_motion.h"

#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "parts/scene.h"

namespace crowdface {
namespace {

Positions cloud() {
  return testing::Shapes().box({-1, 0, 2}, {3, 1, 5}).vertex({7, -2, 1}).mesh().positions;
}

std::vector<std::uint32_t> rows_of(const Positions& positions) {
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(positions.rows()));
  std::iota(rows.begin(), rows.end(), 0U);
  return rows;
}

TEST(RigidMotion, RecoversWhatMovedThePoints) {
  const Positions from = cloud();
  for (const double angle : {0.0, 1e-6, 0.4, 1.8, 3.1}) {
    const Positions to = testing::moved(from, angle, 1.3, {4, -5, 6});
    const std::vector<double> weights = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    const RigidMotion motion = fit_rigid_motion(from, to, rows_of(from), weights);
    EXPECT_NEAR(motion.scale, 1.3, 1e-12);
    for (Index i = 0; i < from.rows(); ++i) {
      EXPECT_LT((motion.apply(from.row(i).transpose()) - to.row(i).transpose()).norm(), 1e-12)
          << angle;
      EXPECT_LT((motion.apply_inverse(to.row(i).transpose()) - from.row(i).transpose()).norm(),
                1e-12);
    }
  }
}

TEST(RigidMotion, NeverMirrors) {
  const Positions from = cloud();
  Positions to = from;
  to.col(0) *= -1;
  const RigidMotion motion = fit_rigid_motion(from, to, rows_of(from), std::vector<double>(9, 1.0));
  const Eigen::Vector3d x = motion.apply_to_direction({1, 0, 0}),
                        y = motion.apply_to_direction({0, 1, 0});
  EXPECT_GT(x.cross(y).dot(motion.apply_to_direction({0, 0, 1})), 0);
}

TEST(RigidMotion, IsTheBestOfItsNeighbours) {
  const Positions from = cloud();
  Positions to = testing::moved(from, 0.5, 0.9, {1, 2, 3});
  for (Index i = 0; i < to.rows(); ++i) to(i, i % 3) += 0.3 * static_cast<double>(i % 4);
  const std::vector<double> weights = {1, 0.5, 2, 1, 1, 3, 0.2, 1, 0};
  const auto rows = rows_of(from);
  const auto error = [&](const RigidMotion& motion) {
    double sum = 0;
    for (const std::uint32_t i : rows) {
      sum += weights[i] *
             (motion.apply(from.row(i).transpose()) - to.row(i).transpose()).squaredNorm();
    }
    return sum;
  };
  const RigidMotion best = fit_rigid_motion(from, to, rows, weights);
  for (const double step : {-1e-3, 1e-3}) {
    RigidMotion other = best;
    other.scale += step;
    EXPECT_GT(error(other), error(best));
    for (Index c = 0; c < 3; ++c) {
      other = best;
      other.moved_pivot(c) += step;
      EXPECT_GT(error(other), error(best));
      // A small turn about axis c.
      other = best;
      const Index a = (c + 1) % 3, b = (c + 2) % 3;
      other.rotation.row(a) = best.rotation.row(a) - step * best.rotation.row(b);
      other.rotation.row(b) = best.rotation.row(b) + step * best.rotation.row(a);
      EXPECT_GT(error(other), error(best));
    }
  }
}

}  // namespace
}  // namespace crowdface
