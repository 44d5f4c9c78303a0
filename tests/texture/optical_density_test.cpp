// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/optical_density.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(OpticalDensity, EveryScreenColourComesBack) {
  for (std::size_t value = 0; value < 256; ++value) {
    EXPECT_EQ(srgb8_by_density()[density_by_srgb8()[value]], value);
  }
}

TEST(OpticalDensity, RunsFromWhiteToBlack) {
  EXPECT_EQ(density_of_light(1), 0);
  EXPECT_EQ(density_of_light(2), 0) << "brighter than white";
  EXPECT_EQ(density_of_light(0), 65535);
  EXPECT_EQ(density_of_light(-1), 65535);
}

// What pigments keep back adds up: half the light of a half is a quarter.
TEST(OpticalDensity, AddsWhereLightIsMultiplied) {
  const int half = density_of_light(0.5F), quarter = density_of_light(0.25F);
  EXPECT_NEAR(quarter, 2 * half, 0.002 * quarter);
  EXPECT_NEAR(light_of_density(static_cast<float>(half)), 0.5F, 1e-4F);
}

}  // namespace
}  // namespace crowdface
