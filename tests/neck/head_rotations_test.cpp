// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/head_rotations.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/mesh/alignment.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Eigen::Vector3d kAcross(1, 0, 0);

Positions rotated(const Eigen::AngleAxisd& turn, Positions points) {
  for (Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d moved = turn * Eigen::Vector3d(points.row(i).transpose());
    points.row(i) = moved.transpose() + Eigen::RowVector3d(3, -1, 2);
  }
  return points;
}

double degrees_of(const Eigen::Matrix3d& rotation) {
  return Similarity{rotation}.angle_degrees();
}

/// Points on an egg of 100 mm, each moved by up to `spread_mm`.
Positions egg(unsigned seed, double spread_mm) {
  std::minstd_rand random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  Positions points(400, 3);
  for (Index i = 0; i < points.rows(); ++i) {
    const double y = 2 * (static_cast<double>(i) + 0.5) / 400 - 1,
                 angle = 2.4 * static_cast<double>(i);
    const double radius = 100 * std::sqrt(1 - y * y);
    points.row(i) << radius * std::cos(angle), 130 * y, 0.8 * radius * std::sin(angle);
    for (Index c = 0; c < 3; ++c) points(i, c) += spread_mm * any(random);
  }
  return points;
}

TEST(HeadMotion, IsExactForAHeadThatIsOnlyTurned) {
  const Eigen::AngleAxisd turn(25 * kDegree, Eigen::Vector3d(0.6, 0, 0.8));
  const Positions head = egg(1, 5);
  EXPECT_LT(degrees_of(head_motion(head, rotated(turn, head)).rotation * turn.inverse()), 1e-6);
}

// A long chin moves a tenth of the points far; the least squares tilt the head for it.
TEST(HeadMotion, HardlyFollowsASingleFeature) {
  const Positions head = egg(1, 0);
  Positions other = egg(2, 2);
  for (Index i = 0; i < 40; ++i) other.row(i) += Eigen::RowVector3d(0, 0, 60);
  const double squares = fit_similarity(head, other, ScaleFit::kRigid).angle_degrees();
  EXPECT_GT(squares, 2);
  EXPECT_LT(degrees_of(head_motion(head, other).rotation), 0.2 * squares);
}

TEST(RotationsToMedian, TurnBackTheHeadsThatAreTurned) {
  const Eigen::AngleAxisd turn(10 * kDegree, Eigen::Vector3d(0, 0.8, 0.6));
  std::vector<Positions> heads;
  for (unsigned h = 0; h < 5; ++h) heads.push_back(egg(h, 4));
  heads[1] = rotated(turn, heads[1]);
  const std::vector<Eigen::Matrix3d> rotations = rotations_to_median(heads, kAcross);
  for (std::size_t h = 0; h < heads.size(); ++h) {
    EXPECT_TRUE(h == 1 || rotations[h].isIdentity(0)) << h;
  }
  EXPECT_LT(degrees_of(rotations[1] * turn), 0.6);
}

TEST(RotationsToMedian, AreNoneForHeadsThatDifferInFormOnly) {
  std::vector<Positions> heads;
  for (unsigned h = 0; h < 4; ++h) {
    heads.push_back(egg(h, 6));
    heads.back().col(2) += 0.05 * heads.back().col(1);  // sheared, as by a receding forehead
  }
  for (const Eigen::Matrix3d& rotation : rotations_to_median(heads, kAcross)) {
    EXPECT_TRUE(rotation.isIdentity(0));
  }
}

TEST(PosePart, LeavesOutWhatFormsExplain) {
  const auto part = [](double degrees, const Eigen::Vector3d& axis) {
    const Eigen::AngleAxisd turn(degrees * kDegree, axis);
    return degrees_of(pose_difference(turn.toRotationMatrix(), kAcross));
  };
  EXPECT_EQ(part(5.9, {1, 0, 0}), 0);
  EXPECT_NEAR(part(6.1, {1, 0, 0}), 6.1, 1e-9);
  EXPECT_EQ(part(1.9, {0, 0.6, 0.8}), 0);
  EXPECT_NEAR(part(2.1, {0, 0.6, -0.8}), 2.1, 1e-9);
  EXPECT_NEAR(part(5, {0.6, 0.8, 0}), 4, 0.01) << "without the inclination";
  EXPECT_NEAR(part(15, {0.6, 0.8, 0}), 15, 1e-9);
}

TEST(TurnVector, GivesTheRotationBack) {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(2, -1, 2) / 3).toRotationMatrix();
  const RigidMotion motion =
      nudged({}, Eigen::Vector3d(1, 2, 3), Eigen::Vector3d::Zero(), rotation_vector(rotation), 0);
  EXPECT_LT((motion.rotation - rotation).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((motion.apply({1, 2, 3}) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_TRUE(rotation_vector(Eigen::Matrix3d::Identity()).isZero(0));
}

}  // namespace
}  // namespace crowdface
