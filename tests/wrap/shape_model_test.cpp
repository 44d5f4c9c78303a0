// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/shape_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

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
  return make_model(heads);
}

/// Of coordinate y at two vertices.
double covariance(const ShapeModel& model, Index a, Index b) {
  double sum = 0;
  for (const Positions& mode : model.modes) sum += mode(a, 1) * mode(b, 1);
  return sum;
}

TEST(LocalisedModel, KeepsVariancesAndWhatNeighboursShare) {
  const ShapeModel model = some_model(), local = localised(model, {10, 50});
  EXPECT_EQ(local.mean, model.mean);
  EXPECT_EQ(local.modes.size(), 3 * model.modes.size());
  for (Index v = 0; v < 60; ++v) {
    EXPECT_NEAR(covariance(local, v, v), covariance(model, v, v), 1e-9);
  }
  EXPECT_NEAR(covariance(local, 10, 11), covariance(model, 10, 11),
              0.02 * std::abs(covariance(model, 10, 11)));
}

TEST(LocalisedModel, FarPlacesShareOnlyWhatIsNotLocal) {
  const ShapeModel model = some_model();
  const ShapeModel local = localised(model, {0, 59}, {.reach_mm = 20, .share = 0.7});
  EXPECT_NEAR(covariance(local, 0, 59), 0.3 * covariance(model, 0, 59), 1e-3);
}

}  // namespace
}  // namespace crowdface::testing
