// SPDX-License-Identifier: Apache-2.0
// What casting promises, measured again on the meshes that the program wrote.
#include "crowdface/run/casting.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/reference_distance.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::plan_lines;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

constexpr double kMmPerCm = 10;
/// Meshes hold seven digits, and samples are all vertices of so small a head.
constexpr double kTolerance = 0.01;  // mm

SmallCrowd six_bowls() {
  SmallCrowd crowd;
  crowd.heads = 6;
  crowd.regions = 3;
  crowd.count = 12;
  crowd.sampling = "{smoothness: [0.2, 0.9], extrapolation: [0.9, 1.1]}";
  return crowd;
}

/// The faces of a crowd as written, and the same recipes with every factor 1 by the plain method.
struct Measured {
  explicit Measured(const SmallCrowdFolder& folder, const std::string& out = "out")
      : lines(plan_lines(folder / out)) {
    const reference::Heads heads = folder.reference_heads();
    std::vector<reference::Points> all;
    for (const std::string& name : folder.names()) all.push_back(heads.positions.at(name));
    areas = reference::front_areas(reference::read_obj(folder.head(folder.names()[0])), all);
    for (const std::string& name : folder.names()) head_positions[name] = heads.positions.at(name);
    for (json line : lines) {
      const auto id = line.at("id").get<std::string>();
      as_built.push_back(reference::read_obj(folder / out / "meshes" / (id + ".obj")).vertices);
      for (auto& region : line.at("regions")) region["extrapolation"] = 1.0;
      unit.push_back(reference::blend(heads, line));
    }
  }

  double between(std::size_t a, std::size_t b) const {
    return std::min(reference::distance_mm(areas, as_built[a], as_built[b], kMmPerCm),
                    reference::distance_mm(areas, unit[a], unit[b], kMmPerCm));
  }
  double to_head(std::size_t face, const std::string& head) const {
    const reference::Points& other = head_positions.at(head);
    return std::min(reference::distance_mm(areas, as_built[face], other, kMmPerCm),
                    reference::distance_mm(areas, unit[face], other, kMmPerCm));
  }

  std::vector<json> lines;
  std::vector<double> areas;
  std::map<std::string, reference::Points> head_positions;
  std::vector<reference::Points> as_built, unit;
};

double closest_pair(const Measured& faces) {
  double closest = HUGE_VAL;
  for (std::size_t a = 0; a < faces.lines.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) closest = std::min(closest, faces.between(a, b));
  }
  return closest;
}

TEST(Casting, NearestInThePlanIsTheNearestOfTheMeshes) {
  const SmallCrowdFolder folder(six_bowls());
  run(folder);
  const Measured faces(folder);
  for (std::size_t i = 0; i < faces.lines.size(); ++i) {
    const json& nearest = faces.lines[i].at("nearest");
    double head_mm = HUGE_VAL, crowd_mm = HUGE_VAL;
    for (const std::string& name : folder.names()) {
      head_mm = std::min(head_mm, faces.to_head(i, name));
    }
    EXPECT_NEAR(nearest.at("face_mm").get<double>(), head_mm, kTolerance);
    EXPECT_NEAR(faces.to_head(i, nearest.at("face").get<std::string>()), head_mm, kTolerance);
    for (std::size_t j = 0; j < i; ++j) crowd_mm = std::min(crowd_mm, faces.between(i, j));
    if (i == 0) continue;
    EXPECT_NEAR(nearest.at("crowd_mm").get<double>(), crowd_mm, kTolerance);
  }
}

TEST(Casting, DistancesThatAreAskedForAreKept) {
  for (const char* mode : {"first_fit", "spread"}) {
    SmallCrowd crowd = six_bowls();
    crowd.more =
        concat("diversity: {mode: ", mode,
               ", min_distance: 0.8 mm, min_distance_to_faces: 0.6 mm, max_weight: 0.8}\n");
    const SmallCrowdFolder folder(crowd);
    run(folder);
    const Measured faces(folder);
    ASSERT_EQ(faces.lines.size(), 12U);
    EXPECT_GE(closest_pair(faces), 0.8 - kTolerance) << mode;
    for (std::size_t i = 0; i < faces.lines.size(); ++i) {
      for (const std::string& name : folder.names()) {
        EXPECT_GE(faces.to_head(i, name), 0.6 - kTolerance) << mode;
      }
      for (const json& region : faces.lines[i].at("regions")) {
        for (const auto& [head, weight] : region.at("weights").items()) {
          EXPECT_LE(weight.get<double>(), 0.8) << mode;
        }
      }
    }
    const json casting = testing::read_json(folder.out() / "casting.json");
    EXPECT_NEAR(casting.at("distances").at("between_faces_mm").at("min").get<double>(),
                closest_pair(faces), kTolerance);
    EXPECT_EQ(testing::read_json(folder.out() / "report.json").at("casting"), casting);
    testing::expect_meshes_match_plan(folder, folder.out());
  }
}

TEST(Casting, GrowingTheCrowdMovesNoFace) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "diversity: {min_distance: 0.5 mm, quotas: {ann: 0.25, bob: 0.25}}\n"
      "families: [{name: kin, members: 2, max_distance: 3 mm}]\n";
  const SmallCrowdFolder folder(crowd);
  ConfigOverrides few, many;
  few.count = "5";
  many.count = "24";
  run_to(folder, "few", few);
  run_to(folder, "many", many);
  const std::string small = testing::read_text(folder / "few/plan.jsonl");
  EXPECT_EQ(testing::read_text(folder / "many/plan.jsonl").substr(0, small.size()), small);
}

TEST(Casting, QuotasAreMetByCount) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 41;
  crowd.more = "diversity: {quotas: {ann: 0.3, bob: 0.125}}\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  std::size_t ann = 0, bob = 0, n = 0;
  for (const json& line : plan_lines(folder.out())) {
    ++n;
    ann += line.at("target") == "ann" ? 1U : 0U;
    bob += line.at("target") == "bob" ? 1U : 0U;
    EXPECT_GE(ann, n * 3 / 10) << n;
    EXPECT_LE(ann, n * 3 / 10 + 1) << n;
    EXPECT_GE(bob, n / 8) << n;
    EXPECT_LE(bob, n / 8 + 1) << n;
  }
  EXPECT_EQ(ann, 12U);
  EXPECT_EQ(bob, 5U);
}

TEST(Casting, FamiliesKeepTogether) {
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

TEST(Casting, ChildrenOfFamiliesAndAges) {
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

TEST(Casting, ReviewsRedrawWhatTheyRejectAndNothingElse) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "diversity: {min_distance: 0.8 mm}\n"
      "families: [{name: kin, members: 3, max_distance: 3 mm}]\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto before = plan_lines(folder.out());
  const fs::path review =
      folder.folder().write("review.yaml",
                            "schema: 1\nfaces:\n  mob_0003: reject\n  mob_0004: keep\n"
                            "  mob_0005: {lock: [region_2], note: \"the nose is good\"}\n"
                            "  mob_kin_02: {mark: reject}\n  mob_0007: {note: fine}\n");
  ConfigOverrides overrides;
  overrides.review = {review.string()};
  run(folder, overrides, Replace::kForce);
  const auto after = plan_lines(folder.out());
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto id = before[i].at("id").get<std::string>();
    EXPECT_EQ(after[i].at("id"), id);
    if (id == "mob_0003" || id == "mob_0005" || id == "mob_kin_02") {
      EXPECT_NE(after[i].at("regions"), before[i].at("regions")) << id;
      EXPECT_GT(after[i].at("attempt"), before[i].at("attempt")) << id;
    } else if (id == "mob_0007") {
      EXPECT_EQ(after[i].at("note"), "fine");
      EXPECT_EQ(after[i].at("regions"), before[i].at("regions"));
    } else {
      EXPECT_EQ(after[i].dump(), before[i].dump()) << id;
    }
    if (id == "mob_0005") {
      EXPECT_EQ(after[i].at("note"), "the nose is good");
      EXPECT_EQ(after[i].at("target"), before[i].at("target"));
      EXPECT_EQ(after[i].at("regions").at("region_2"), before[i].at("regions").at("region_2"));
      EXPECT_NE(after[i].at("regions").at("region_1"), before[i].at("regions").at("region_1"));
    }
  }
  const Measured faces(folder);
  for (std::size_t a = 0; a < after.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (after[a].at("family").is_null() || after[b].at("family").is_null()) {
        EXPECT_GE(faces.between(a, b), 0.8 - kTolerance);
      }
    }
  }
  // The folder keeps the review: its own config and the user's give the reviewed crowd again.
  const auto again = [&](const fs::path& config, const std::vector<std::string>& reviews) {
    ConfigOverrides round;
    round.out = folder.out().string();
    round.review = reviews;
    generate(config, round, {folder.cache(), Replace::kRefuse, false});
    return plan_lines(folder.out());
  };
  EXPECT_EQ(again(folder.out() / "config.yaml", {}), after);
  EXPECT_EQ(again(folder.config(), {}), after);
  EXPECT_EQ(again(folder.config(), {review.string()}), after) << "it counts once";
}

TEST(Casting, ReviewsAddUpInRounds) {
  SmallCrowd crowd = six_bowls();
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto first = plan_lines(folder.out());
  const auto reject = [&](const std::string& id, const std::string& file) {
    ConfigOverrides round;
    round.review = {
        folder.folder().write(file, "schema: 1\nfaces: {" + id + ": reject}\n").string()};
    plan(folder.config(), round, {folder.cache(), Replace::kRefuse, false});
    return plan_lines(folder.out());
  };
  const auto second = reject("mob_0003", "one.yaml");
  const auto third = reject("mob_0005", "two.yaml");
  EXPECT_NE(second[2], first[2]);
  EXPECT_EQ(third[2], second[2]) << "the second round undoes nothing of the first";
  EXPECT_NE(third[4], second[4]);
  run(folder);
  EXPECT_EQ(plan_lines(folder.out()), third) << "as the gallery's page says";
  EXPECT_TRUE(fs::exists(folder.out() / "reviews/review_002.yaml"));

  // What was rejected is kept, and what came in its place is no double of it.
  std::vector<json> rejected;
  std::ifstream file(folder.out() / "rejected.jsonl");
  for (std::string line; std::getline(file, line);) rejected.push_back(json::parse(line));
  ASSERT_EQ(rejected.size(), 2U);
  EXPECT_EQ(rejected[0], first[2]);
  const Measured faces(folder);
  std::vector<double> all;
  for (std::size_t a = 0; a < faces.lines.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) all.push_back(faces.between(a, b));
  }
  std::sort(all.begin(), all.end());
  const reference::Points old = reference::blend(folder.reference_heads(), rejected[1]);
  EXPECT_GE(reference::distance_mm(faces.areas, faces.as_built[4], old, kMmPerCm),
            0.4 * all[all.size() / 2]);

  // A folder of another config is refused by its key; with --force its reviews are not applied.
  ConfigOverrides other;
  other.seed = "12";
  testing::expect_error(ExitCode::kUsage, {"another config's crowd", "crowd.seed"},
                        [&] { run(folder, other); });
  plan(folder.config(), other, {folder.cache(), Replace::kForce, false});
  EXPECT_FALSE(fs::exists(folder.out() / "reviews"));
  EXPECT_FALSE(fs::exists(folder.out() / "rejected.jsonl"));
}

TEST(Casting, AskingForDistanceLowersNothing) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 30;
  const SmallCrowdFolder folder(crowd);
  const auto closest = [&](const std::vector<std::string>& set) {
    ConfigOverrides overrides;
    overrides.set = set;
    plan(folder.config(), overrides, {folder.cache(), Replace::kForce, false});
    return testing::read_json(folder.out() / "casting.json")
        .at("distances")
        .at("between_faces_mm")
        .at("min")
        .get<double>();
  };
  const double defaults = closest({});
  EXPECT_GE(closest({"diversity.min_distance=0.1 mm"}), defaults);
  EXPECT_GE(closest({"diversity.candidates=1"}), defaults);
  EXPECT_GE(closest({"diversity.candidates=1", "diversity.min_distance=0.1 mm"}), defaults);
}

TEST(Casting, GroupsHaveTheirSharesAndTheirOwnHeads) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "groups:\n"
      "  - {name: few, share: 0.25, targets: [ann], sources: [ann, bob]}\n"
      "  - {name: three, count: 3, targets: [cyd], extrapolation: 1.05}\n"
      "  - {name: rest, sources: [cyd, dan]}\n"
      "families: [{name: kin, group: few, members: 2, "
      "parents: {mother: drawn, father: {group: rest}}}]\n";
  const SmallCrowdFolder folder(crowd);
  ConfigOverrides small, large;
  small.count = "11";
  large.count = "27";
  run_to(folder, "small", small);
  run_to(folder, "large", large);
  const std::string few = testing::read_text(folder / "small/plan.jsonl");
  EXPECT_EQ(testing::read_text(folder / "large/plan.jsonl").substr(0, few.size()), few);
  std::map<std::string, int> faces;
  for (const json& line : plan_lines(folder / "large")) {
    if (line.at("id") == "mob_kin_mother") EXPECT_FALSE(line.contains("group"));
    if (line.at("id") == "mob_kin_father") EXPECT_EQ(line.at("group"), "rest");
    if (line.at("index").is_null()) continue;
    const auto group = line.at("group").get<std::string>();
    ++faces[group];
    for (const json& region : line.at("regions")) {
      for (const auto& [head, weight] : region.at("weights").items()) {
        if (group == "few") EXPECT_TRUE(head == "ann" || head == "bob");
        if (group == "rest") {
          EXPECT_TRUE(head == "cyd" || head == "dan" || head == line.at("target"));
        }
      }
      if (group == "three") EXPECT_EQ(region.at("extrapolation"), 1.05);
    }
    if (group == "few") EXPECT_EQ(line.at("target"), "ann");
  }
  EXPECT_EQ(faces["few"], 6);
  EXPECT_EQ(faces["three"], 3);
  EXPECT_EQ(faces["rest"], 18);
  const json groups = testing::read_json(folder / "large/casting.json").at("groups");
  EXPECT_GE(groups.at("few").at("faces"), 6);
  EXPECT_THAT(testing::read_text(folder / "large/crowd.csv"), ::testing::HasSubstr(",rest,"));
}

TEST(Casting, DrawnParentsStandOnHeadsOfTheirSex) {
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

TEST(Casting, ChildrenOfAGroupAreMadeOfItsHeads) {
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

TEST(Casting, AQuotaThatTheSourcesContradictIsWarnedOf) {
  SmallCrowd crowd = six_bowls();
  crowd.sampling = "{sources: [cyd, dan], smoothness: [0.2, 0.9]}";
  crowd.more = "diversity: {quotas: {ann: 0.5}}\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const json warnings = testing::read_json(folder.out() / "report.json").at("warnings");
  EXPECT_THAT(warnings.dump(), ::testing::HasSubstr("faces of the quota ann have"));
}

TEST(Casting, ChildrenResembleBothParentsThroughGenerations) {
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

  // A parent has children who take after it.
  ConfigOverrides review;
  review.review = {
      folder.folder().write("r.yaml", "schema: 1\nfaces: {mob_smith_mother: reject}\n").string()};
  testing::expect_error(ExitCode::kUsage, {"children who take after it"}, [&] {
    plan(folder.config(), review, {folder.cache(), Replace::kRefuse, false});
  });
}

TEST(Casting, WhatCannotBeDoneIsToldAndLeavesNothing) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 60;
  crowd.more = "diversity: {min_distance: 4 mm, max_attempts: 60}\n";
  const SmallCrowdFolder folder(crowd);
  std::string message;
  try {
    run(folder);
    FAIL() << "expected to be refused";
  } catch (const Error& error) {
    message = error.what();
    EXPECT_EQ(error.code(), ExitCode::kUnsatisfiable);
  }
  EXPECT_THAT(message, ::testing::HasSubstr("min_distance, 4 mm"));
  EXPECT_THAT(message, ::testing::HasSubstr("of 60 faces"));
  EXPECT_FALSE(fs::exists(folder.out()));
  // The distance that it says is possible is.
  const std::string start = "were cast in a trial: ";
  const std::size_t at = message.find(start);
  ASSERT_NE(at, std::string::npos) << message;
  const std::string mm =
      message.substr(at + start.size(), message.find(" mm", at) - at - start.size());
  run(folder, {concat("diversity.min_distance=", mm, " mm")});
  EXPECT_EQ(plan_lines(folder.out()).size(), 60U);
  EXPECT_GE(closest_pair(Measured(folder)), *parse_double(mm) - kTolerance);
  // The last faces were hard to find, and that was said while they were looked for.
  const std::string log = testing::read_text(folder.out() / "crowdface.log");
  EXPECT_LT(log.find("faces are getting scarce: number "), log.find("casting: 60"));
}

TEST(Casting, ExtrapolationThatGoesTooFarIsThrownAway) {
  SmallCrowd crowd = six_bowls();
  crowd.sampling = "{smoothness: [0.2, 0.9], extrapolation: [1, 4]}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const json thrown = testing::read_json(folder.out() / "casting.json").at("thrown_away");
  std::uint64_t unbelievable = 0;
  for (const char* reason : {"max_deviation", "max_stretch", "max_flipped", "max_intersecting"}) {
    unbelievable += thrown.at(reason).get<std::uint64_t>();
  }
  EXPECT_GT(unbelievable, 0U);
  run_to(folder, "anything", {{"believability=none"}, {}, {}, {}});
  const json let_pass = testing::read_json(folder / "anything/casting.json").at("thrown_away");
  EXPECT_FALSE(let_pass.empty());
  for (const json& count : let_pass) EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace crowdface
