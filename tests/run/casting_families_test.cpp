// SPDX-License-Identifier: Apache-2.0
// What casting promises to families, measured again on the meshes that the program wrote.
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"

#include "run/measured_crowd.h"
#include "support/expect_error.h"

namespace crowdface {
namespace {

using nlohmann::json;
using testing::kTolerance;
using testing::Measured;
using testing::plan_lines;
using testing::six_bowls;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

TEST(CastingFamilies, FamiliesKeepTogether) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "families:\n"
      "  - {name: smith, members: 4, target: ann, max_distance: 2 mm, min_distance: 0.3 mm}\n"
      "  - {name: jones, members: 3, parents: {mother: bob, father: cyd}, "
      "inherit: {region_1: mother, region_2: father}, max_distance: 2 mm, min_distance: 0.3 mm}\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const Measured faces(folder);
  ASSERT_EQ(faces.lines.size(), 12U + 7U);
  const auto family = [&](std::size_t i) {
    const json& name = faces.lines[i].at("family");
    return name.is_null() ? std::string() : name.get<std::string>();
  };
  for (std::size_t i = 0; i < faces.lines.size(); ++i) {
    if (family(i).empty()) continue;
    double own = 0, other = HUGE_VAL;
    for (std::size_t j = 0; j < faces.lines.size(); ++j) {
      if (i == j) continue;
      const double mm = faces.between(i, j);
      if (family(i) == family(j)) {
        EXPECT_GE(mm, 0.3 - kTolerance);
        EXPECT_LE(mm, 4 + kTolerance) << "both within 2 mm of the founder";
        own = std::max(own, mm);
      } else {
        other = std::min(other, mm);
      }
    }
    EXPECT_LT(own, other) << faces.lines[i].at("id");
    EXPECT_EQ(faces.lines[i].at("target") == "ann", family(i) == "smith");
    if (family(i) == "jones") {
      EXPECT_EQ(faces.lines[i].at("inherits").at("region_1"), "mother");
      EXPECT_EQ(faces.lines[i].at("inherits").at("region_2"), "father");
    }
  }
  const json families = testing::read_json(folder.out() / "casting.json").at("families");
  ASSERT_EQ(families.size(), 2U);
  for (const json& one : families) {
    EXPECT_LE(one.at("to_founder_mm").at("max").get<double>(), 2);
    EXPECT_GT(one.at("silhouette").get<double>(), 0);
  }
  testing::expect_meshes_match_plan(folder, folder.out());
}

TEST(CastingFamilies, ChildrenOfFamiliesAndAges) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 3;
  crowd.more =
      "families:\n"
      "  - {name: smith, members: 2, target: ann, max_distance: 2 mm}\n"
      "  - {name: jones, members: 2, target: bob, max_distance: 2 mm}\n"
      "  - {name: young, members: 3, parents: {mother: smith_01, father: jones_02}, "
      "max_distance: 2 mm}\n"
      "recipes:\n"
      "  - {id: before, target: ann, regions: {all: {weights: {ann: 1}, smoothness: 0.5}}}\n"
      "  - {id: after, target: ann, age: 0.75, regions: {all: {weights: {ann: 1}, smoothness: 0.5, "
      "extrapolation: 1}}}\n";
  const SmallCrowdFolder folder(crowd);
  const std::string text = testing::read_text(folder.config());
  folder.folder().write(
      "config.yaml",
      std::string(text).replace(text.find("align: none"), 11, "align: none, tags: {dan: [old]}"));
  run(folder);
  std::set<std::string> targets;
  for (const json& line : plan_lines(folder.out())) {
    if (line.at("family") == "young") {
      EXPECT_TRUE(line.at("target") == "ann" || line.at("target") == "bob");
      EXPECT_EQ(line.at("inherits").size(), 3U);
    }
    if (line.at("id") == "after") {
      EXPECT_EQ(line.at("age"), 0.75);
      for (const json& region : line.at("regions")) {
        EXPECT_DOUBLE_EQ(region.at("weights").at("dan").get<double>(), 0.75);
        EXPECT_DOUBLE_EQ(region.at("weights").at("ann").get<double>(), 0.25);
      }
    }
  }
  const Measured faces(folder);
  EXPECT_LT(faces.to_head(1, "dan"), faces.to_head(0, "dan")) << "older is more like dan";
}

TEST(CastingFamilies, DrawnParentsStandOnHeadsOfTheirSex) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "families:\n"
      "  - {name: a, members: 1, parents: {mother: drawn, father: drawn}}\n"
      "  - {name: b, members: 1, parents: {mother: drawn, father: drawn}}\n";
  const SmallCrowdFolder folder(crowd);
  const auto targets = [&](const std::string& tags, const std::string& out) {
    run_to(folder, out, {{concat("faces.tags=", tags)}, {}, {}, {}});
    std::map<std::string, std::string> of_role;
    for (const json& line : plan_lines(folder / out)) {
      const std::string id = line.at("id");
      if (id.ends_with("_mother")) of_role["mother"] += line.at("target").get<std::string>();
      if (id.ends_with("_father")) of_role["father"] += line.at("target").get<std::string>();
    }
    return of_role;
  };
  auto both = targets("{ann: [female], bob: [old, male]}", "both");
  EXPECT_EQ(both["mother"], "annann");
  EXPECT_EQ(both["father"], "bobbob");
  EXPECT_EQ(targets("{bob: [male]}", "one")["father"], "bobbob") << "and no head is a woman's";
}

// Members were settled before their drawn parents joined the crowd, and never compared with them.
TEST(CastingFamilies, ChildrenKeepTheirDistanceFromDrawnParents) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 1;
  crowd.more =
      "diversity: {min_distance: 1.2 mm}\n"
      "families: [{name: kin, members: 3, parents: {mother: drawn, father: drawn}, max_distance: "
      "2.5 mm, min_distance: 0.4 mm}]\n";
  const SmallCrowdFolder folder(crowd);
  for (const char* seed : {"1", "2", "3", "4"}) {
    ConfigOverrides overrides;
    overrides.seed = seed;
    run_to(folder, seed, overrides);
    const Measured faces(folder, seed);
    ASSERT_EQ(faces.lines.size(), 6U);
    EXPECT_EQ(faces.lines[0].at("id"), "mob_kin_mother");
    for (std::size_t child = 2; child < 5; ++child) {
      for (const std::size_t parent : {0U, 1U}) {
        EXPECT_GE(faces.between(parent, child), 1.2 - kTolerance) << seed;
      }
    }
  }
}

TEST(CastingFamilies, ChildrenOfAGroupAreMadeOfItsHeads) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "groups:\n"
      "  - {name: women, tags: [female]}\n"
      "  - {name: men, tags: [male]}\n"
      "families:\n"
      "  - {name: girls, group: women, members: 2, parents: {mother: {group: women}, father: "
      "{group: men}}}\n"
      "  - {name: boys, group: men, members: 2, parents: {mother: girls_mother, father: "
      "girls_father}}\n"
      "  - {name: heads, group: women, members: 1, parents: {mother: ann, father: dan}}\n";
  const SmallCrowdFolder folder(crowd);
  run(folder,
      {"faces.tags={ann: [female, fair], bob: [female, fair], cyd: [female, dark], dan: [male, "
       "fair], "
       "eve: [male, dark], fay: [male, dark]}"});
  const std::set<std::string> women = {"ann", "bob", "cyd"};
  std::map<std::string, int> children;
  for (const json& line : plan_lines(folder.out())) {
    if (line.at("family").is_null()) continue;
    const auto family = line.at("family").get<std::string>();
    ++children[family];
    const bool female = family != "boys";
    std::set<std::string> heads = {line.at("target").get<std::string>()};
    if (line.contains("mixture")) {
      for (const auto& [head, share] : line.at("mixture").items()) heads.insert(head);
    }
    for (const json& region : line.at("regions")) {
      for (const auto& [head, weight] : region.at("weights").items()) heads.insert(head);
    }
    for (const std::string& head : heads) {
      EXPECT_EQ(women.contains(head), female) << line.at("id") << " has some of " << head;
    }
    EXPECT_EQ(line.at("group"), female ? "women" : "men");
    // Of the women bob has most in common with dan and is nobody's parent.
    if (family == "heads") {
      EXPECT_TRUE(heads.contains("bob"));
    }
  }
  EXPECT_EQ(children, (std::map<std::string, int>{{"girls", 2}, {"boys", 2}, {"heads", 1}}));
}

TEST(CastingFamilies, ChildrenResembleBothParentsThroughGenerations) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 8;
  crowd.more =
      "families:\n"
      "  - {name: smith, members: 3, parents: {mother: drawn, father: drawn}, max_distance: 1.5 "
      "mm}\n"
      "  - {name: green, members: 2, parents: {mother: smith_01, father: drawn}, max_distance: 1.5 "
      "mm}\n"
      "  - {name: brown, members: 2, parents: {mother: drawn, father: smith_02}, max_distance: 1.5 "
      "mm}\n"
      "  - {name: pair, members: 2, twins: true, parents: {mother: ann, father: bob}}\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  testing::expect_meshes_match_plan(folder, folder.out());
  const Measured faces(folder);
  std::map<std::string, std::size_t> at;
  for (std::size_t i = 0; i < faces.lines.size(); ++i) at[faces.lines[i].at("id")] = i;
  ASSERT_EQ(at.size(), 8U + 9U + 4U);
  EXPECT_LT(at.at("mob_smith_mother"), at.at("mob_smith_01"));
  for (const json& line : faces.lines) {
    if (line.at("family") == "smith") {
      EXPECT_EQ(line.at("parents").at("mother"), "mob_smith_mother");
      EXPECT_GT(line.at("mother_share").get<double>(), 0.1);
      EXPECT_LT(line.at("mother_share").get<double>(), 0.9);
    }
  }
  const auto mm = [&](const std::string& a, const std::string& b) {
    return faces.between(at.at("mob_" + a), at.at("mob_" + b));
  };
  EXPECT_LE(mm("pair_01", "pair_02"), 1 + kTolerance) << "twins";
  EXPECT_LT(mm("green_01", "green_02"), mm("green_01", "brown_01")) << "siblings, cousins";
  EXPECT_LT(mm("brown_01", "brown_02"), mm("brown_01", "green_02"));
  const json casting = testing::read_json(folder.out() / "casting.json");
  for (const json& family : casting.at("families")) {
    EXPECT_LE(family.at("to_founder_mm").at("max").get<double>(), 1.5 + kTolerance);
  }

  // Children stay near their parents' mean, so parents who stay make them stay when the crowd grows.
  ConfigOverrides more;
  more.count = "20";
  run_to(folder, "more", more);
  const std::string few = testing::read_text(folder.out() / "plan.jsonl");
  EXPECT_EQ(testing::read_text(folder / "more/plan.jsonl").substr(0, few.size()), few);

  // A parent cannot be rejected, because its children take after it.
  ConfigOverrides review;
  review.review = {
      folder.folder().write("r.yaml", "schema: 1\nfaces: {mob_smith_mother: reject}\n").string()};
  testing::expect_error(ExitCode::kUsage, {"is a parent and cannot be rejected"}, [&] {
    plan(folder.config(), review, {folder.cache(), Replace::kRefuse, false});
  });
}

}  // namespace
}  // namespace crowdface
