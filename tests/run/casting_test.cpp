// SPDX-License-Identifier: Apache-2.0
// What casting promises, measured again on the meshes that the program wrote.
#include "crowdface/run/casting.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "run/measured_crowd.h"
#include "support/expect_error.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::closest_pair;
using testing::kMmPerCm;
using testing::kTolerance;
using testing::Measured;
using testing::plan_lines;
using testing::six_bowls;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

TEST(CastingOptions, NearestInThePlanIsTheNearestOfTheMeshes) {
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

TEST(CastingOptions, DistancesThatAreAskedForAreKept) {
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

// Of 300 faces of 16 heads, 10 passed for a head if the config asked for nothing.
TEST(CastingOptions, FacesKeepAwayFromHeadsByDefault) {
  for (const char* mode : {"first_fit", "spread"}) {
    SmallCrowd crowd = six_bowls();
    crowd.count = 200;
    crowd.more = concat("diversity: {mode: ", mode, "}\n");
    const SmallCrowdFolder folder(crowd);
    plan(folder.config(), {}, {folder.cache(), Replace::kRefuse, false});
    const json heads =
        testing::read_json(folder.out() / "casting.json").at("distances").at("between_heads_mm");
    const double limit = std::min(0.5, 0.1 * heads.at("median").get<double>()) - 1e-3;
    for (const json& line : plan_lines(folder.out())) {
      EXPECT_GE(line.at("nearest").at("face_mm").get<double>(), limit) << mode << line.at("id");
    }
  }
}

TEST(CastingOptions, FacesNearHeadsAreMadeIfTheConfigGivesNoOthers) {
  SmallCrowd crowd = six_bowls();
  crowd.more = "groups: [{name: a, targets: [ann], sources: [ann]}]\n";
  const SmallCrowdFolder folder(crowd);
  plan(folder.config(), {}, {folder.cache(), Replace::kRefuse, false});
  const auto lines = plan_lines(folder.out());
  EXPECT_EQ(lines.size(), 12U);
  for (const json& line : lines) {
    EXPECT_LT(line.at("nearest").at("face_mm").get<double>(), 0.1) << line.at("id");
  }
}

TEST(CastingOptions, GrowingTheCrowdMovesNoFace) {
  SmallCrowd crowd = six_bowls();
  crowd.more =
      "diversity: {min_distance: 0.5 mm}\n"
      "groups: [{name: a, share: 0.25, targets: [ann]}, {name: b, share: 0.25, targets: [bob]}]\n"
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

TEST(CastingOptions, SharesOfGroupsAreMetByCount) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 41;
  crowd.more =
      "groups: [{name: a, share: 0.3, targets: [ann]}, {name: b, share: 0.125, targets: [bob]}, "
      "{name: rest, targets: [cyd, dan]}]\n";
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

TEST(CastingOptions, ReviewsRedrawWhatTheyRejectAndNothingElse) {
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

TEST(CastingOptions, ReviewsAddUpInRounds) {
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

  // A folder of another config is refused by its key; with --force its reviews stay and apply.
  ConfigOverrides other;
  other.seed = "12";
  testing::expect_error(ExitCode::kUsage, {"another config's crowd", "crowd.seed"},
                        [&] { run(folder, other); });
  plan(folder.config(), other, {folder.cache(), Replace::kForce, false});
  EXPECT_TRUE(fs::exists(folder.out() / "reviews/review_001.yaml"));
  EXPECT_TRUE(fs::exists(folder.out() / "rejected.jsonl"));
}

TEST(CastingOptions, AskingForDistanceLowersNothing) {
  SmallCrowd crowd = six_bowls();
  crowd.count = 30;
  const SmallCrowdFolder folder(crowd);
  const auto closest = [&](const std::vector<std::string>& set) {
    ConfigOverrides overrides;
    overrides.assignments = set;
    plan(folder.config(), overrides, {folder.cache(), Replace::kForce, false});
    return testing::read_json(folder.out() / "casting.json")
        .at("distances")
        .at("between_faces_mm")
        .at("min")
        .get<double>();
  };
  const double defaults = closest({});
  EXPECT_GE(closest({"diversity.min_distance=0.1 mm"}), defaults);
}

TEST(CastingOptions, GroupsHaveTheirSharesAndTheirOwnHeads) {
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
    if (line.at("id") == "mob_kin_mother") {
      EXPECT_FALSE(line.contains("group"));
    }
    if (line.at("id") == "mob_kin_father") {
      EXPECT_EQ(line.at("group"), "rest");
    }
    if (line.at("index").is_null()) continue;
    const auto group = line.at("group").get<std::string>();
    ++faces[group];
    for (const json& region : line.at("regions")) {
      for (const auto& [head, weight] : region.at("weights").items()) {
        if (group == "few") {
          EXPECT_TRUE(head == "ann" || head == "bob");
        }
        if (group == "rest") {
          EXPECT_TRUE(head == "cyd" || head == "dan" ||
                      head == line.at("target").get<std::string>());
        }
      }
      if (group == "three") {
        EXPECT_EQ(region.at("extrapolation"), 1.05);
      }
    }
    if (group == "few") {
      EXPECT_EQ(line.at("target"), "ann");
    }
  }
  EXPECT_EQ(faces["few"], 6);
  EXPECT_EQ(faces["three"], 3);
  EXPECT_EQ(faces["rest"], 18);
  const json groups = testing::read_json(folder / "large/casting.json").at("groups");
  EXPECT_GE(groups.at("few").at("faces"), 6);
  EXPECT_THAT(testing::read_text(folder / "large/crowd.csv"), ::testing::HasSubstr(",rest,"));
}

/// What a run that cannot be done says.
std::string refusal(const SmallCrowdFolder& folder, const std::vector<std::string>& set = {}) {
  try {
    run(folder, set);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUnsatisfiable);
    return error.what();
  }
  ADD_FAILURE() << "expected to be refused";
  return {};
}

TEST(CastingOptions, WhatCannotBeDoneIsToldAndLeavesNothing) {
  SmallCrowd crowd = six_bowls();
  for (const int count : {24, 60, 500}) {
    crowd.count = count;
    crowd.more = "diversity: {min_distance: 4 mm}\n";
    const SmallCrowdFolder folder(crowd);
    const std::string message = refusal(folder);
    EXPECT_THAT(message, ::testing::HasSubstr("min_distance, 4 mm"));
    EXPECT_THAT(message, ::testing::HasSubstr(concat("of ", count, " faces")));
    EXPECT_FALSE(fs::exists(folder.out()));
    // The distance that the message names is possible, a tenth more is not.
    const std::string start = "were cast in a trial: ";
    const std::size_t at = message.find(start);
    ASSERT_NE(at, std::string::npos) << message;
    const double mm = *parse_double(
        message.substr(at + start.size(), message.find(" mm", at) - at - start.size()));
    refusal(folder, {concat("diversity.min_distance=", 1.1 * mm, " mm")});
    run(folder, {concat("diversity.min_distance=", mm, " mm")});
    EXPECT_EQ(plan_lines(folder.out()).size(), static_cast<std::size_t>(count));
    EXPECT_GE(closest_pair(Measured(folder)), mm - kTolerance);
  }
}

TEST(CastingOptions, ExtrapolationThatGoesTooFarIsThrownAway) {
  SmallCrowd crowd = six_bowls();
  crowd.sampling = "{smoothness: [0.2, 0.9], extrapolation: [1, 4]}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const json thrown = testing::read_json(folder.out() / "casting.json").at("thrown_away");
  run_to(folder, "anything", {{"believability=none"}, {}, {}, {}});
  const json let_pass = testing::read_json(folder / "anything/casting.json").at("thrown_away");
  std::uint64_t unbelievable = 0;
  for (const char* reason : {"max_deviation", "max_stretch", "max_flipped", "max_intersecting"}) {
    unbelievable += thrown.at(reason).get<std::uint64_t>();
    EXPECT_EQ(let_pass.at(reason), 0) << reason;
  }
  EXPECT_GT(unbelievable, 0U);
}

}  // namespace
}  // namespace crowdface
