// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/steer_trait.h"

#include <cmath>

#include <gtest/gtest.h>

namespace crowdface::testing {
namespace {

/// Two regions of three heads. The first region's heads measure 10, 20 and 40; the second hardly counts.
class SteerTrait : public ::testing::Test {
 protected:
  SteerTrait() {
    recipe_.regions.resize(2);
    for (RegionRecipe& region : recipe_.regions) {
      region.weights = {{0, 0.5}, {1, 0.5}};
      region.position = PlanePoint(0, 0);
    }
  }
  static double measure(const Recipe& recipe) {
    double value = 0;
    for (const SourceWeight& source : recipe.regions[0].weights) {
      value += source.weight * (source.head == 0 ? 10 : source.head == 1 ? 20 : 40);
    }
    for (const SourceWeight& source : recipe.regions[1].weights) {
      value += source.weight * 0.01 * static_cast<double>(source.head);
    }
    return value;
  }
  Recipe steered(double wanted) const {
    return steer_trait(recipe_, {{0, 0, {0, 1, 2}}, {1, 0, {0, 1, 2}}}, wanted, measure);
  }
  Recipe recipe_;
};

TEST_F(SteerTrait, TheMeasurementComesToTheValue) {
  for (const double wanted : {12.0, 15.0, 22.5, 39.0}) {
    const Recipe face = steered(wanted);
    EXPECT_NEAR(measure(face), wanted, 0.01);
    double sum = 0;
    for (const SourceWeight& source : face.regions[0].weights) {
      EXPECT_GT(source.weight, 0);
      sum += source.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_FALSE(face.regions[0].position) << "weights and a place would contradict each other";
  }
}

TEST_F(SteerTrait, NoOtherWeightsWithThatMeasurementAreNearer) {
  const Recipe face = steered(18);
  const auto distance = [&](double first, double second, double third) {
    return std::hypot(first - 0.5, second - 0.5, third);
  };
  const auto& weights = face.regions[0].weights;
  ASSERT_EQ(weights.size(), 3U);
  const double own = distance(weights[0].weight, weights[1].weight, weights[2].weight);
  for (double third = 0; third < 0.27; third += 0.01) {  // the others that measure 18
    const double second = 0.8 - 3 * third;
    EXPECT_LE(own, distance(1 - second - third, second, third) + 1e-3);
  }
}

TEST_F(SteerTrait, ARegionThatHardlyCountsStays) {
  const Recipe face = steered(18);
  EXPECT_EQ(face.regions[1].weights, recipe_.regions[1].weights);
  EXPECT_TRUE(face.regions[1].position);
}

TEST_F(SteerTrait, BeyondTheHeadsItIsTheFarthestHead) {
  EXPECT_NEAR(measure(steered(50)), 40.005, 0.02);
  EXPECT_NEAR(measure(steered(5)), 10.005, 0.02);
}

}  // namespace
}  // namespace crowdface::testing
