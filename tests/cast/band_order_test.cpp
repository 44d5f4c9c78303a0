// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/band_order.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

using ::testing::ElementsAre;

Recipe recipe_of(const std::vector<std::vector<std::uint64_t>>& levels) {
  Recipe recipe;
  for (const auto& of_region : levels) {
    RegionRecipe region;
    region.finer_bands.resize(of_region.size() - 1);
    for (std::size_t b = 0; b < of_region.size(); ++b) {
      band_of(region, b).iterations = of_region[b];
      band_of(region, b).smoothness = static_cast<double>(of_region[b]) / 100;
    }
    recipe.regions.push_back(std::move(region));
  }
  return recipe;
}

std::vector<std::uint64_t> levels_of(const RegionRecipe& region) {
  std::vector<std::uint64_t> levels;
  for (std::size_t b = 0; b < band_count(region); ++b) {
    levels.push_back(band_of(region, b).iterations);
    EXPECT_EQ(band_of(region, b).smoothness, static_cast<double>(levels.back()) / 100);
  }
  return levels;
}

std::vector<std::uint64_t> taken_over(const std::vector<std::size_t>& parts,
                                      const std::vector<std::uint64_t>& from,
                                      const std::vector<std::uint64_t>& to) {
  Recipe recipe = recipe_of({{9, 5, 1}, to});
  std::vector<std::size_t> of_second_region;
  for (const std::size_t band : parts) of_second_region.push_back(to.size() + band);
  copy_bands(of_second_region, recipe_of({{7, 3, 2}, from}), recipe);
  EXPECT_THAT(levels_of(recipe.regions[0]), ElementsAre(9, 5, 1)) << "nothing of it is taken";
  return levels_of(recipe.regions[1]);
}

TEST(BandOrder, TheFinerBandGivesWay) {
  Recipe recipe = recipe_of({{40, 60, 50}});
  restore_level_order(recipe.regions[0]);
  EXPECT_THAT(levels_of(recipe.regions[0]), ElementsAre(40, 40, 40));
}

// A locked finer band was cut down to a coarser one that had been drawn anew.
TEST(BandOrder, WhatIsTakenOverStaysAndOthersGiveWay) {
  EXPECT_THAT(taken_over({2}, {80, 50, 30}, {20, 10, 5}), ElementsAre(30, 30, 30));
  EXPECT_THAT(taken_over({1}, {80, 50, 30}, {20, 10, 5}), ElementsAre(50, 50, 5));
  EXPECT_THAT(taken_over({1}, {80, 50, 30}, {90, 70, 60}), ElementsAre(90, 50, 50));
  EXPECT_THAT(taken_over({0}, {30, 20, 10}, {90, 70, 5}), ElementsAre(30, 30, 5));
  EXPECT_THAT(taken_over({0, 2}, {80, 50, 30}, {99, 90, 1}), ElementsAre(80, 80, 30));
  EXPECT_THAT(taken_over({0, 1, 2}, {80, 50, 30}, {3, 2, 1}), ElementsAre(80, 50, 30));
  EXPECT_THAT(taken_over({}, {80, 50, 30}, {3, 2, 1}), ElementsAre(3, 2, 1));
}

}  // namespace
}  // namespace crowdface
