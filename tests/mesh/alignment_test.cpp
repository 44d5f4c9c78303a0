// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/alignment.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

TEST(FitSimilarity, RecoversAKnownMotion) {
  Similarity motion;
  motion.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  motion.translation = Eigen::Vector3d(3, -4, 5);
  motion.scale = 1.25;
  const Positions points = testing::random_positions(50, 1);
  const Similarity found = fit_similarity(points, motion.apply(points), ScaleFit::kUniform);
  EXPECT_LT((found.rotation - motion.rotation).norm(), 1e-12);
  EXPECT_LT((found.translation - motion.translation).norm(), 1e-12);
  EXPECT_NEAR(found.scale, 1.25, 1e-12);
  EXPECT_NEAR(found.angle_degrees(), 0.7 * 180 / 3.14159265358979, 1e-9);
}

TEST(FitSimilarity, NeverMirrors) {
  const Positions points = testing::random_positions(50, 2);
  Positions mirrored = points;
  mirrored.col(0) *= -1;
  EXPECT_NEAR(fit_similarity(points, mirrored, ScaleFit::kRigid).rotation.determinant(), 1, 1e-12);
}

TEST(FitSimilarity, RigidLeavesTheSizeAlone) {
  const Positions points = testing::random_positions(50, 3);
  const Positions twice = 2 * points;
  EXPECT_EQ(fit_similarity(points, twice, ScaleFit::kRigid).scale, 1);
  EXPECT_NEAR(fit_similarity(points, twice, ScaleFit::kUniform).scale, 2, 1e-12);
}

TEST(FitSimilarity, IgnoresPointsWithoutWeight) {
  const Positions points = testing::random_positions(20, 4);
  Positions moved = points.rowwise() + Eigen::RowVector3d(1, 0, 0);
  moved.row(7) << 100, 100, 100;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(20);
  weights(7) = 0;
  const Similarity fit = fit_similarity(points, moved, ScaleFit::kRigid, weights);
  EXPECT_LT((fit.translation - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST(FitSimilarity, RefusesUnequalLists) {
  EXPECT_THROW(fit_similarity(Positions::Zero(5, 3), Positions::Zero(4, 3), ScaleFit::kRigid),
               BrokenPrecondition);
  EXPECT_THROW(fit_similarity(Positions::Zero(2, 3), Positions::Zero(2, 3), ScaleFit::kRigid),
               InvalidInput);
}

}  // namespace
}  // namespace crowdface
