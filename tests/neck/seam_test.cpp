// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/seam.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/mesh/all_columns.h"

#include "tube.h"

namespace crowdface {
namespace {

using testing::Tube;

/// The neck of a tube whose lower ring has to move by `moves`.
class NeckOfATube : public ::testing::Test {
 protected:
  static constexpr double kFalloff = 60;

  NeckOfATube()
      : topology_(tube_.topology()),
        adjacency_(build_adjacency(topology_)),
        mesh_(tube_.positions()),
        goal_(mesh_(tube_.rim(), kAllColumns)) {
    for (Index i = 0; i < goal_.rows(); ++i) {
      goal_.row(i) += Eigen::RowVector3d(4 + std::sin(static_cast<double>(i)), -2, 3);
    }
  }
  Seam seam() const {
    return {tube_.rim(), goal_, Positions::Constant(goal_.rows(), 3, std::sqrt(1.0 / 3)),
            NeckBend(topology_, adjacency_, mesh_, tube_.rim(), kFalloff)};
  }
  /// Largest displacement in a row of the tube.
  double moved(const Positions& by, Index row) const {
    return by.middleRows(row * tube_.around, tube_.around).rowwise().norm().maxCoeff();
  }

  Tube tube_{.around = 48, .rows = 24};
  Topology topology_;
  Adjacency adjacency_;
  Positions mesh_, goal_;
};

TEST_F(NeckOfATube, BendsTheRimExactly) {
  Positions fitted = mesh_;
  seam().bend_to_seam(fitted);
  EXPECT_EQ(fitted(tube_.rim(), kAllColumns), goal_);
  const Positions once = fitted;
  seam().bend_to_seam(fitted);
  EXPECT_EQ(fitted, once) << "a fitted neck stays as it is";
}

TEST_F(NeckOfATube, FadesSmoothlyToZeroAtTheFalloff) {
  Positions fitted = mesh_;
  seam().bend_to_seam(fitted);
  const Positions by = fitted - mesh_;
  const double row_mm = tube_.height / tube_.rows;
  const auto last = static_cast<Index>(kFalloff / row_mm);
  for (Index row = 1; row < last; ++row) EXPECT_LT(moved(by, row), moved(by, row - 1)) << row;
  for (Index row = last + 1; row <= tube_.rows; ++row) EXPECT_EQ(moved(by, row), 0) << row;
  // Zero slope at both ends: the first and last steps are smaller than those of a linear ramp.
  const double step = moved(by, 0) / static_cast<double>(last);
  EXPECT_LT(moved(by, last), 0.5 * step);
  EXPECT_LT(moved(by, 0) - moved(by, 1), 0.8 * step);
  // The steepest step of a cubic ramp is 1.5 times that of a linear one.
  for (Index row = 0; row < last; ++row) {
    EXPECT_LT(moved(by, row) - moved(by, row + 1), 2 * step);
  }
}

// A step in the displacement's second derivative would show as a crease.
TEST_F(NeckOfATube, HasNoCrease) {
  goal_ = mesh_(tube_.rim(), kAllColumns);
  goal_.col(0).array() += 6;
  Positions fitted = mesh_;
  seam().bend_to_seam(fitted);
  const Positions by = fitted - mesh_;
  const auto at = [&](Index row) { return by(row * tube_.around, 0); };
  double before = 0;
  const double row_mm = tube_.height / tube_.rows;
  for (Index row = 1; row < tube_.rows; ++row) {
    const double curvature = (at(row - 1) - 2 * at(row) + at(row + 1)) / (row_mm * row_mm);
    EXPECT_LT(std::abs(curvature), 10 * 6 / (kFalloff * kFalloff)) << row;
    const double change = row > 1 ? curvature - std::exchange(before, curvature) : 0;
    EXPECT_LT(std::abs(change), 5 * 6 / (kFalloff * kFalloff)) << row;
    before = curvature;
  }
}

TEST_F(NeckOfATube, ARigidShiftOfRimAndGoalChangesNothingElse) {
  Positions shifted = mesh_;
  shifted.rowwise() += Eigen::RowVector3d(1, 2, 3);
  Positions a = mesh_, b = shifted;
  const Seam own = seam();
  own.bend_to_seam(a);
  goal_.rowwise() += Eigen::RowVector3d(1, 2, 3);
  seam().bend_to_seam(b);
  EXPECT_LT((b - a - (shifted - mesh_)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(NeckOfATube, HoldsShapesStillAtTheRim) {
  Displacements moves;
  for (std::uint32_t v = 0; v < mesh_.rows(); ++v) {
    if (v % 3 != 1) moves.vertices.push_back(v);
  }
  moves.moves = testing::random_positions(static_cast<Index>(moves.vertices.size()), 5);
  Positions before = mesh_, after = mesh_;
  moves.add_to(before);
  seam().keep_rim_still(moves);
  moves.add_to(after);
  EXPECT_TRUE(std::ranges::is_sorted(moves.vertices));
  EXPECT_EQ(after(tube_.rim(), kAllColumns), mesh_(tube_.rim(), kAllColumns));
  EXPECT_EQ(after.bottomRows(8 * tube_.around), before.bottomRows(8 * tube_.around));
  // Held displacements are those of a mesh whose rim is bent back.
  Positions bent = before;
  Seam{tube_.rim(),
       mesh_(tube_.rim(), kAllColumns),
       {},
       NeckBend(topology_, adjacency_, mesh_, tube_.rim(), kFalloff)}
      .bend_to_seam(bent);
  EXPECT_LT((bent - after).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(NeckOfATube, LeavesShapesThatDoNotMoveTheRim) {
  Displacements moves{{200, 700}, Positions::Ones(2, 3)};
  seam().keep_rim_still(moves);
  EXPECT_EQ(moves.vertices, (std::vector<std::uint32_t>{200, 700}));
}

TEST_F(NeckOfATube, SetsTheNormalsOfTheRim) {
  Positions normals = Positions::Zero(mesh_.rows(), 3), none;
  seam().set_normals(normals);
  seam().set_normals(none);
  EXPECT_EQ(normals(tube_.rim(), kAllColumns), seam().normals);
  EXPECT_TRUE(normals.bottomRows(mesh_.rows() - tube_.around).isZero(0));
  EXPECT_EQ(none.rows(), 0);
}

}  // namespace
}  // namespace crowdface
