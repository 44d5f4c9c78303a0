// SPDX-License-Identifier: Apache-2.0
// Faces spelled out by hand.
#include <gtest/gtest.h>

#include "crowdface/core/text.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using testing::plan_lines;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

constexpr const char* kRecipes =
    "recipes:\n"
    "  - {id: plain, target: cyd, regions: {all: {weights: {ann: 2, dan: 6}, smoothness: 0.5,\n"
    "     extrapolation: 1}}}\n"
    "  - {id: placed, target: ann, regions: {region_1: {position: [0.25, -0.5], iterations: 7},\n"
    "     all: {weights: {bob: 1}, smoothness: [0.1, 0.2], extrapolation: 1.25}}}\n"
    "  - {id: bare}\n"
    "  - {id: sized, regions: {region_2: {smoothness: 30 mm}}}\n";

TEST(GenerateRecipes, StandAsWrittenBeforeTheSampledFaces) {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.more = kRecipes;
  crowd.count = 2;
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto lines = plan_lines(folder.out());
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[4].at("id"), "mob_0001");
  EXPECT_EQ(lines[4].at("index"), 1);

  const auto& plain = lines[0];
  EXPECT_EQ(plain.at("id"), "plain");
  EXPECT_TRUE(plain.at("index").is_null());
  EXPECT_EQ(plain.at("target"), "cyd");
  for (const auto& [name, region] : plain.at("regions").items()) {
    EXPECT_TRUE(region.at("position").is_null());
    EXPECT_EQ(region.at("weights"), (nlohmann::json{{"ann", 0.25}, {"dan", 0.75}}));
    EXPECT_EQ(region.at("smoothness"), 0.5);
    EXPECT_EQ(region.at("iterations"), 30);
    EXPECT_EQ(region.at("extrapolation"), 1.0);
  }

  const auto& placed = lines[1].at("regions");
  EXPECT_EQ(placed.at("region_1").at("position"), (nlohmann::json{0.25, -0.5}));
  EXPECT_EQ(placed.at("region_1").at("iterations"), 7);
  for (const char* name : {"region_2", "region_3"}) {
    EXPECT_EQ(placed.at(name).at("weights"), (nlohmann::json{{"bob", 1.0}}));
    EXPECT_EQ(placed.at(name).at("extrapolation"), 1.25);
    EXPECT_GE(placed.at(name).at("smoothness"), 0.1);
    EXPECT_LE(placed.at(name).at("smoothness"), 0.2);
  }

  EXPECT_FALSE(lines[2].at("regions").at("region_1").at("position").is_null()) << "drawn";
  EXPECT_NE(lines[2].at("regions"), lines[3].at("regions"));
  testing::expect_meshes_match_plan(folder, folder.out());
  testing::expect_weights_match_positions(folder, folder.out());
}

TEST(GenerateRecipes, LeaveTheSampledFacesAsTheyAre) {
  SmallCrowd crowd;
  crowd.regions = 3;
  const SmallCrowdFolder without(crowd);
  run(without);
  crowd.more = kRecipes;
  const SmallCrowdFolder with(crowd);
  run(with);
  for (int i = 1; i <= crowd.count; ++i) {
    const std::string mesh = concat("meshes/mob_000", i, ".obj");
    EXPECT_EQ(testing::read_text(without.out() / mesh), testing::read_text(with.out() / mesh));
  }
}

TEST(GenerateRecipes, AnotherRecipeBeforeLeavesTheRestAsTheyAre) {
  SmallCrowd crowd;
  crowd.more = "recipes: [{id: last}]\n";
  const SmallCrowdFolder alone(crowd);
  run(alone);
  crowd.more = "recipes: [{id: first, target: ann}, {id: last}]\n";
  const SmallCrowdFolder second(crowd);
  run(second);
  EXPECT_EQ(testing::read_text(alone.out() / "meshes/last.obj"),
            testing::read_text(second.out() / "meshes/last.obj"));
}

TEST(GenerateRecipes, SmoothnessBeyondTheMeshIsRefused) {
  SmallCrowd crowd;
  crowd.more = "recipes: [{id: mine, regions: {all: {iterations: 61}}}]\n";
  crowd.smoothing_limit = "max_size: 60 mm";
  crowd.sampling = "{smoothness: [0, 1]}";
  const SmallCrowdFolder folder(crowd);
  testing::expect_error(ExitCode::kUsage, {"mine", "61"}, [&] { run(folder); });
  EXPECT_FALSE(std::filesystem::exists(folder.out()));
}

}  // namespace
}  // namespace crowdface
