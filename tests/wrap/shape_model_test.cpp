// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/shape_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/wrap/shape_regression.h"

namespace crowdface::testing {
namespace {

/// Points along a line, 5 mm apart; heads that differ at random.
ShapeModel some_model() {
  std::vector<Positions> heads;
  for (std::uint64_t h = 0; h < 6; ++h) {
    Positions head(60, 3);
    for (Index v = 0; v < head.rows(); ++v) {
      const RandomKey key{h, static_cast<std::uint64_t>(v), "test/head"};
      head.row(v) << 5.0 * static_cast<double>(v) + random_normal(key, 0), random_normal(key, 1),
          random_normal(key, 2);
    }
    heads.push_back(head);
  }
  return make_shape_model(heads);
}

/// Of coordinate y at two vertices.
double covariance(const ShapeModel& model, Index a, Index b) {
  double sum = 0;
  for (const Positions& mode : model.modes) sum += mode(a, 1) * mode(b, 1);
  return sum;
}

TEST(ShapeModel, MirrorImagesOfItsHeadsAreHeadsToo) {
  const ShapeModel model = some_model();
  MirrorMap map;  // two points each are partners
  for (std::uint32_t v = 0; v < 60; ++v) {
    map.corners.push_back({v ^ 1U, v, v});
    map.barycentric.push_back({1, 0, 0});
  }
  const ShapeModel both = add_mirror_images(model, map);
  EXPECT_EQ(both.mean, model.mean);
  for (Index v = 0; v < 60; ++v) {
    const Index other = v ^ 1;
    EXPECT_NEAR(covariance(both, v, v),
                (covariance(model, v, v) + covariance(model, other, other)) / 2, 1e-9);
    EXPECT_NEAR(covariance(both, v, v), covariance(both, other, other), 1e-9);
  }
}

/// A flat sheet of 13 by 13 points, 8 mm apart; heads are shifted to the side as far as they are raised.
TEST(ShapeRegression, WhereAPlaceLiesAlongTheSurfaceFollowsFromHowHeadsDiffer) {
  constexpr int kSide = 13;
  SkinMesh skin;
  ShapeModel model{Positions(kSide * kSide, 3), {Positions::Zero(kSide * kSide, 3)}};
  for (std::uint32_t v = 0; v < kSide * kSide; ++v) {
    const std::uint32_t column = v % kSide, row = v / kSide;
    skin.vertices.push_back(v);
    skin.ambient_visibility.push_back(1);
    // A dome, so that moving along it is not the same as staying.
    const double x = 8.0 * column - 48, y = 8.0 * row - 48;
    model.mean.row(v) << x, y, -(x * x + y * y) / 200;
    model.modes[0].row(v) << 4 * std::exp(-y * y / 800), 0, 4 * std::exp(-y * y / 800);
    if (column + 1 == kSide || row + 1 == kSide) continue;
    skin.triangles.push_back({v, v + 1, v + kSide + 1});
    skin.triangles.push_back({v, v + kSide + 1, v + kSide});
  }
  skin.adjacency = build_adjacency(topology_of(skin.triangles, kSide * kSide));
  const Positions head = model.mean + model.modes[0];
  const ScanSurface scan(Scan{head, skin.triangles});
  const auto off = [&](const ShapeModel& used) {
    const Positions found =
        regress_shape(skin, used, model.mean, scan, {}, {.smooth_deformation_deviation_mm = 0.1});
    return (found - head).rowwise().norm().mean();
  };
  EXPECT_LT(off(model), 0.5);
  EXPECT_GT(off({model.mean, {}}), 1.5);
}

}  // namespace
}  // namespace crowdface::testing
