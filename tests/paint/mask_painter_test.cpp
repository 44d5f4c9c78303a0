// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/mask_painter.h"

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/core/require.h"
#include "crowdface/core/smooth_step.h"

#include "paint/sheets.h"

namespace crowdface::testing {
namespace {

using Alpha = RegionWeights::Alpha;

/// Three regions: left, right and, in the middle of both, a little of a third.
Alpha soft_regions(const Positions& positions) {
  Alpha alpha(positions.rows(), 3);
  for (Index v = 0; v < positions.rows(); ++v) {
    const double right = smooth_step(-0.4, 0.4, positions(v, 0));
    const double third = 0.2 * smooth_step(0.5, 0, std::abs(positions(v, 0)));
    alpha.row(v) << (1 - right) * (1 - third), right * (1 - third), third;
  }
  return alpha;
}

void expect_weights(const Alpha& alpha) {
  EXPECT_GE(alpha.minCoeff(), 0);
  EXPECT_LT((alpha.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

Brush brush_of(BrushMode mode, double radius, double strength = 1, double falloff = 1) {
  return {mode, radius, strength, falloff, false};
}

TEST(MaskPainter, WeightsStayWeightsAndEverythingIsTakenBackExactly) {
  const Sheet sheet(24);
  MaskPainter painter(sheet.topology, sheet.positions, {}, soft_regions(sheet.positions));
  std::vector<Alpha> states = {painter.alpha()};
  for (std::uint64_t i = 0; i < 24; ++i) {
    const auto at = random_pair({7, i, "test/stroke"});
    const SurfacePoint place = painter.surface().nearest({2 * at[0] - 1, 2 * at[1] - 1, 0});
    const Index region = static_cast<Index>(i) % painter.alpha().cols();
    Brush brush = brush_of(static_cast<BrushMode>(i % 4), 0.2 + at[0] / 2, 0.3 + 0.7 * at[1],
                           i % 3 == 0 ? 0 : 1);
    brush.paints_mirror_image = i % 2 == 0;
    painter.paint(region, {place}, brush);
    expect_weights(painter.alpha());
    expect_weights(painter.alpha_without(region));
    states.push_back(painter.alpha());
  }
  for (std::size_t i = states.size() - 1; i > 0; --i) {
    EXPECT_EQ(painter.alpha(), states[i]);
    EXPECT_TRUE(painter.undo());
  }
  EXPECT_EQ(painter.alpha(), states[0]);
  EXPECT_FALSE(painter.undo());
}

TEST(MaskPainter, AStrokeThatGoesOnIsTakenBackAsOne) {
  const Sheet sheet(16);
  MaskPainter painter(sheet.topology, sheet.positions, {}, soft_regions(sheet.positions));
  const Alpha before = painter.alpha();
  for (int i = 0; i < 5; ++i) {
    const SurfacePoint place = painter.surface().nearest({0.2 * i - 0.5, 0, 0});
    painter.paint(0, {place}, brush_of(BrushMode::kAdd, 0.4, 0.5), i > 0);
  }
  EXPECT_NE(painter.alpha(), before);
  EXPECT_TRUE(painter.undo());
  EXPECT_EQ(painter.alpha(), before);
  EXPECT_FALSE(painter.can_undo());
}

TEST(MaskPainter, TheBrushIsFullInItsMiddleAndNothingBeyondItsRadius) {
  const Sheet sheet(40);
  for (const double falloff : {0.0, 0.5, 1.0}) {
    MaskPainter painter(sheet.topology, sheet.positions, {}, soft_regions(sheet.positions));
    const Alpha before = painter.alpha();
    const auto rows = painter.paint(2, {painter.surface().nearest({0, 0, 0})},
                                    brush_of(BrushMode::kAdd, 0.5, 1, falloff));
    double sum = 0;
    for (Index v = 0; v < before.rows(); ++v) {
      const double away = sheet.positions.row(v).norm();
      if (away < 0.001 || away < 0.48 * (1 - falloff)) {
        EXPECT_NEAR(painter.alpha()(v, 2), 1, 0.001);
      }
      if (away > 0.501) {
        EXPECT_EQ(painter.alpha().row(v), before.row(v));
      }
      sum += painter.alpha()(v, 2) - before(v, 2);
    }
    EXPECT_GT(sum, 0);
    for (const std::uint32_t v : rows) EXPECT_LT(sheet.positions.row(v).norm(), 0.501);
    painter.paint(2, {painter.surface().nearest({0, 0, 0})},
                  brush_of(BrushMode::kErase, 0.5, 1, 0));
    for (const std::uint32_t v : rows) EXPECT_LT(painter.alpha()(v, 2), 1e-12);
    expect_weights(painter.alpha());
  }
}

TEST(MaskPainter, ErasingWhatIsARegionsAloneLeavesItToThoseAround) {
  const Sheet sheet(10);
  Alpha alpha = Alpha::Zero(sheet.positions.rows(), 3);
  alpha.col(0).setOnes();
  alpha.topRows(50).setZero();
  alpha.topRows(50).col(2).setOnes();
  MaskPainter painter(sheet.topology, sheet.positions, {}, alpha);
  const auto rows = painter.paint(0, {painter.surface().nearest({0, 0, 0})},
                                  brush_of(BrushMode::kErase, 0.5, 1, 0));
  for (const std::uint32_t v : rows) EXPECT_EQ(painter.alpha()(v, 2), 1);
  const Alpha rest = painter.alpha_without(0);
  expect_weights(rest);
  EXPECT_EQ(rest(120, 1), 1) << "filled from where another region is";
}

TEST(MaskPainter, DoesNotPaintTheOtherLip) {
  const Sheet sheet = folded_sheet(40);
  Alpha alpha = Alpha::Zero(sheet.positions.rows(), 2);
  alpha.col(0).setOnes();
  MaskPainter painter(sheet.topology, sheet.positions, {}, alpha);
  const SurfacePoint place = painter.surface().nearest({0.6, 0, 0});
  for (const BrushMode mode : {BrushMode::kAdd, BrushMode::kGrow, BrushMode::kSmooth}) {
    painter.paint(1, {place}, brush_of(mode, 0.5));
  }
  EXPECT_GT(painter.alpha().col(1).sum(), 10);
  for (Index v = 0; v < alpha.rows(); ++v) {
    if (sheet.positions(v, 2) > 0) {
      EXPECT_EQ(painter.alpha()(v, 1), 0);
    }
  }
}

TEST(MaskPainter, MirroredStrokesAreSymmetric) {
  constexpr std::uint32_t kSide = 30;
  const Sheet sheet(kSide);
  Alpha alpha = Alpha::Zero(sheet.positions.rows(), 2);
  alpha.col(0).setOnes();
  for (const BrushMode mode : {BrushMode::kAdd, BrushMode::kGrow, BrushMode::kSmooth}) {
    MaskPainter painter(sheet.topology, sheet.positions, {}, alpha);
    Brush brush = brush_of(BrushMode::kAdd, 0.4, 0.8);
    brush.paints_mirror_image = true;
    painter.paint(1, {painter.surface().nearest({0.3, 0.21, 0})}, brush);
    brush.mode = mode;
    painter.paint(1, {painter.surface().nearest({-0.2, -0.1, 0})}, brush);
    EXPECT_GT(painter.alpha().col(1).maxCoeff(), 0.7);
    for (Index v = 0; v < alpha.rows(); ++v) {
      const Index column = v % (kSide + 1), mirrored = v - column + (kSide - column);
      EXPECT_NEAR(painter.alpha()(v, 1), painter.alpha()(mirrored, 1), 1e-9);
    }
  }
}

/// What a brush does is measured along the surface, not in vertices.
TEST(MaskPainter, SmoothingAndGrowingReachAsFarAtAnyResolution) {
  for (const BrushMode mode : {BrushMode::kSmooth, BrushMode::kGrow}) {
    std::vector<double> shares;
    for (const std::uint32_t side : {80U, 160U}) {
      const Sheet sheet(side);
      Alpha alpha(sheet.positions.rows(), 2);
      for (Index v = 0; v < alpha.rows(); ++v) {
        const double right = sheet.positions(v, 0) > 0.01 ? 1 : 0;
        alpha.row(v) << 1 - right, right;
      }
      MaskPainter painter(sheet.topology, sheet.positions, {}, alpha);
      painter.paint(1, {painter.surface().nearest({0, 0, 0})}, brush_of(mode, 0.64, 1, 0));
      // The mean share of region 1 in a strip left of the border.
      double sum = 0, count = 0;
      for (Index v = 0; v < alpha.rows(); ++v) {
        const double x = sheet.positions(v, 0), y = sheet.positions(v, 1);
        if (x > -0.2 && x < 0 && std::abs(y) < 0.2) {
          sum += painter.alpha()(v, 1);
          count += 1;
        }
      }
      shares.push_back(sum / count);
    }
    EXPECT_GT(shares[0], 0.05);
    EXPECT_NEAR(shares[0], shares[1], 0.08);
  }
}

TEST(MaskPainter, NumbersOutsideTheirRangesAreRefused) {
  const Sheet sheet(4);
  MaskPainter painter(sheet.topology, sheet.positions, {}, soft_regions(sheet.positions));
  const std::vector<SurfacePoint> at = {painter.surface().nearest({0, 0, 0})};
  EXPECT_THROW(painter.paint(3, at, {}), BrokenPrecondition);
  EXPECT_THROW(painter.paint(0, at, brush_of(BrushMode::kAdd, 0)), BrokenPrecondition);
  EXPECT_THROW(painter.paint(0, at, brush_of(BrushMode::kAdd, 1, 1.1)), BrokenPrecondition);
  EXPECT_THROW(painter.alpha_without(3), BrokenPrecondition);
  EXPECT_FALSE(painter.can_undo());
}

}  // namespace
}  // namespace crowdface::testing
