// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/mean_head.h"

#include <cmath>

#include <gtest/gtest.h>

#include "head_models/synth/layout.h"
#include "head_models/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

TEST(Sculpture, LineMeetsTheSkin) {
  for (const Vector3d& guide : {Vector3d(0, 0, 9), Vector3d(0, 11, 0), Vector3d(7, 3, -1),
                                Vector3d(-7, 3, -1), Vector3d(0, 2, -9), Vector3d(3, -7, 8)}) {
    const Vector3d on = project_onto_skin({0, 0, 0}, guide);
    EXPECT_NEAR(skin_distance(on), 0, 1e-9);
    EXPECT_NEAR(on.normalized().dot(guide.normalized()), 1, 1e-12);
    EXPECT_NEAR(skin_normal(on).norm(), 1, 1e-12);
    EXPECT_GT(skin_distance(on + 0.01 * skin_normal(on)), 0);
  }
}

TEST(Sculpture, LeftEqualsRight) {
  EXPECT_EQ(skin_distance({2.5, -3, 9}), skin_distance({-2.5, -3, 9}));
}

TEST(MeanHead, SkinIsOnTheSculpture) {
  const Layout layout = make_layout(5000);
  for (const LatticePoint& lattice_point : layout.lattice_points) {
    if (lattice_point.patch == SkinPatch::kEar || lattice_point.patch == SkinPatch::kEarCore)
      continue;
    const bool strip =
        lattice_point.patch == SkinPatch::kStrip || lattice_point.patch == SkinPatch::kCap;
    if (!strip && lattice_point.b > 1) continue;
    ASSERT_NEAR(skin_distance(mean_skin(lattice_point).position), 0, 1e-8);
  }
}

TEST(MeanHead, RingsBeginWhereTheStripEnds) {
  for (const SkinPatch patch :
       {SkinPatch::kEye, SkinPatch::kNostril, SkinPatch::kMouth, SkinPatch::kEar}) {
    const Opening& opening = opening_of(patch);
    // The middle of the opening's upper side: the strip at the same place.
    const double middle = (column_distance(opening.column0) + column_distance(opening.column1)) / 2;
    const Vector3d strip =
        mean_skin({SkinPatch::kStrip, 1, middle, row_distance(opening.row0)}).position;
    const Vector3d ring = mean_skin({patch, 1, 3.5, 1e-9}).position;
    EXPECT_LT((strip - ring).norm(), 1e-5);
  }
}

TEST(MeanHead, HasHumanProportions) {
  const Layout layout = make_layout(20000);
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  for (const LatticePoint& lattice_point : layout.lattice_points) {
    const Vector3d p = mean_skin(lattice_point).position;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Head breadth at the ears 17 … 20, length with nose 20 … 24, height with neck 26 … 30 cm.
  EXPECT_GT(high.x() - low.x(), 16);
  EXPECT_LT(high.x() - low.x(), 20);
  EXPECT_GT(high.z() - low.z(), 20);
  EXPECT_LT(high.z() - low.z(), 24);
  EXPECT_GT(high.y() - low.y(), 26);
  EXPECT_LT(high.y() - low.y(), 30);
}

}  // namespace
}  // namespace crowdface::synth
