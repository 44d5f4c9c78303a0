// SPDX-License-Identifier: Apache-2.0
// Whole runs with bands of detail against the plain computation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using json = nlohmann::json;
using testing::plan_lines;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

/// Three bands over three regions, called so that their names' order is theirs.
SmallCrowd banded() {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.sampling =
      "{smoothness: [0.5, 1], extrapolation: [0.8, 1.3], max_sources: 3, bands: {a_build: {}, "
      "b_features: {smoothness: {iterations: [8, 20]}, sources: [ann, bob], extrapolation: 1.1}, "
      "c_skin: {smoothness: {iterations: 3}, sources: [dan], position: {distribution: uniform}}}}";
  return crowd;
}

const json& region(const json& line, int number) {
  return line.at("regions").at(concat("region_", number));
}

TEST(GenerateBands, MeshesAreTheSumOfTheBands) {
  for (const char* levels : {"exact", "basis", "cubic"}) {
    SmallCrowd crowd = banded();
    crowd.levels = levels;
    crowd.more =
        "recipes: [{id: mine, target: cyd, regions: {all: {weights: {ann: 1}, extrapolation: 0.9, "
        "bands: {c_skin: {weights: {bob: 3, dan: 1}, iterations: 2}}}}}]\n";
    const SmallCrowdFolder folder(crowd);
    run(folder);
    testing::expect_meshes_match_plan(folder, folder.out());
    testing::expect_weights_match_positions(folder, folder.out());
    const auto lines = plan_lines(folder.out());
    ASSERT_EQ(lines.size(), 5U);
    for (int k = 1; k <= 3; ++k) {
      const json& mine = region(lines[0], k);
      EXPECT_EQ(mine.at("weights"), (json{{"ann", 1.0}}));
      EXPECT_EQ(mine.at("bands").at("b_features").at("weights"), (json{{"ann", 1.0}}));
      EXPECT_EQ(mine.at("bands").at("c_skin").at("weights"), (json{{"bob", 0.75}, {"dan", 0.25}}));
      EXPECT_EQ(mine.at("bands").at("c_skin").at("iterations"), 2);
      const json& drawn = region(lines[1], k).at("bands").at("b_features");
      EXPECT_GE(drawn.at("iterations"), 8);
      EXPECT_LE(drawn.at("iterations"), 20);
      EXPECT_EQ(drawn.at("extrapolation"), 1.1);
    }
    const json bands = testing::read_json(folder.out() / "report.json").at("smoothing").at("bands");
    ASSERT_EQ(bands.size(), 3U);
    EXPECT_EQ(bands[1].at("name"), "b_features");
    EXPECT_GT(bands[0].at("begins_mm")[0], bands[1].at("begins_mm")[1]);
    EXPECT_EQ(testing::read_text(folder.out() / "crowd.csv").find("region_1_a_build"),
              std::string::npos);
    EXPECT_NE(testing::read_text(folder.out() / "crowd.csv").find(",region_3_c_skin_iterations,"),
              std::string::npos);
  }
}

TEST(GenerateBands, ARunGoesOnWhereItWasWithBands) {
  const SmallCrowdFolder folder(banded());
  run(folder);
  const auto lines = plan_lines(folder.out());
  run(folder);
  EXPECT_EQ(plan_lines(folder.out()), lines);
}

TEST(GenerateBands, ALockedBandStays) {
  const SmallCrowdFolder folder(banded());
  run(folder);
  const auto before = plan_lines(folder.out());
  ConfigOverrides round;
  round.review = {folder.folder()
                      .write("review.yaml",
                             "schema: 1\nfaces: {mob_0002: {lock: [c_skin, region_2/a_build]}}\n")
                      .string()};
  run(folder, round);
  const auto after = plan_lines(folder.out());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i != 1) {
      EXPECT_EQ(after[i], before[i]);
    }
  }
  EXPECT_EQ(after[1].at("target"), before[1].at("target"));
  for (int k = 1; k <= 3; ++k) {
    const json &now = region(after[1], k), &then = region(before[1], k);
    EXPECT_EQ(now.at("bands").at("c_skin"), then.at("bands").at("c_skin"));
    EXPECT_NE(now.at("bands").at("b_features"), then.at("bands").at("b_features"));
    EXPECT_EQ(now.at("weights") == then.at("weights"), k == 2);
  }
}

TEST(GenerateBands, ChildrenInheritByBand) {
  SmallCrowd crowd = banded();
  crowd.heads = 6;
  crowd.count = 3;
  crowd.more =
      "families: [{name: kin, members: 2, parents: {mother: ann, father: bob}, inherit: "
      "{a_build: mother, b_features: father, region_3/c_skin: father}, max_distance: 20 mm, "
      "min_distance: 0 mm}]\nbelievability: none\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto lines = plan_lines(folder.out());
  const json& child = lines[0];
  ASSERT_EQ(child.at("family"), "kin");
  for (int k = 1; k <= 3; ++k) {
    const json& from = child.at("inherits").at(concat("region_", k));
    EXPECT_EQ(from.at("a_build"), "mother");
    EXPECT_EQ(from.at("b_features"), "father");
    if (k == 3) {
      EXPECT_EQ(from.at("c_skin"), "father");
    }
    // At least three quarters of what it tends to is the parent's.
    EXPECT_GE(region(child, k).at("weights").at("ann").get<double>(), 0.7);
    EXPECT_GE(region(child, k).at("bands").at("b_features").at("weights").at("bob").get<double>(),
              0.7);
  }
}

// Bands of two parents, put together, began above those before them, and blending ended in a bug's words.
TEST(GenerateBands, OfParentsWithOtherLevelsKeepTheirOrder) {
  SmallCrowd crowd = banded();
  crowd.heads = 6;
  crowd.count = 3;
  crowd.more =
      "recipes:\n"
      "  - {id: fine, target: ann, regions: {all: {weights: {ann: 1}, iterations: 10, bands: "
      "{b_features: {iterations: 6}, c_skin: {iterations: 2}}}}}\n"
      "  - {id: coarse, target: bob, regions: {all: {weights: {bob: 1}, iterations: 24, bands: "
      "{b_features: {iterations: 22}, c_skin: {iterations: 20}}}}}\n"
      "families: [{name: kin, members: 2, parents: {mother: fine, father: coarse}, inherit: "
      "{a_build: mother, b_features: father, c_skin: father}, max_distance: 20 mm, "
      "min_distance: 0 mm}]\nbelievability: none\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  int children = 0;
  for (const json& line : plan_lines(folder.out())) {
    if (!line.contains("family") || line.at("family").is_null()) continue;
    ++children;
    for (int k = 1; k <= 3; ++k) {
      const json& whole = region(line, k);
      EXPECT_GE(whole.at("iterations"), whole.at("bands").at("b_features").at("iterations"));
      EXPECT_GE(whole.at("bands").at("b_features").at("iterations"),
                whole.at("bands").at("c_skin").at("iterations"));
    }
  }
  EXPECT_EQ(children, 2);
}

TEST(GenerateBands, AGroupBindsTheHeadsOfABand) {
  SmallCrowd crowd;
  crowd.regions = 2;
  crowd.count = 8;
  crowd.sampling =
      "{targets: [bob], position: {distribution: anchored, pull: 0}, bands: {build: 0.9, skin: "
      "{smoothness: 0.1}}}";
  crowd.more =
      "groups: [{name: with_dan, share: 0.25, bands: {skin: {sources: "
      "[dan]}}}, {name: others, bands: {skin: {sources: [ann, bob, cyd]}}}]\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto lines = plan_lines(folder.out());
  int with_skin = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    bool all = true, any = false;
    for (int k = 1; k <= 2; ++k) {
      const bool from_dan =
          region(lines[i], k).at("bands").at("skin").at("weights").contains("dan");
      all = all && from_dan;
      any = any || from_dan;
    }
    EXPECT_EQ(all, any) << "in every region or in none";
    with_skin += all ? 1 : 0;
    EXPECT_GE(with_skin, static_cast<int>((i + 1) / 4)) << "of the first " << i + 1;
    EXPECT_LE(with_skin, static_cast<int>((i + 1) / 4) + 1) << "of the first " << i + 1;
  }
  const json group = testing::read_json(folder.out() / "casting.json").at("groups").at("with_dan");
  EXPECT_EQ(group.at("faces"), 2);
}

TEST(GenerateBands, ABandTooFineForTheMeshIsWarnedOf) {
  SmallCrowd crowd;
  crowd.count = 2;
  const auto warnings_with = [&](const std::string& skin) {
    crowd.sampling = concat("{bands: {build: 0.9, skin: ", skin, "}}");
    const SmallCrowdFolder folder(crowd);
    run(folder);
    return testing::read_json(folder.out() / "report.json").at("warnings").dump();
  };
  EXPECT_THAT(warnings_with("0.001 mm"), ::testing::HasSubstr("sampling.bands.skin begins at 0"));
  EXPECT_THAT(warnings_with("0.5"), ::testing::Not(::testing::HasSubstr("bands")));
}

TEST(GenerateBands, ThatOverlapAreRefused) {
  SmallCrowd crowd = banded();
  crowd.sampling = "{bands: {one: 0.5, two: [0.4, 0.6]}}";
  const SmallCrowdFolder folder(crowd);
  testing::expect_error(ExitCode::kUsage, {"sampling.bands.two (region_1)", "do not overlap"},
                        [&] { run(folder); });
}

}  // namespace
}  // namespace crowdface
