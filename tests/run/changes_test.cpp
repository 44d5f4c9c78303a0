// SPDX-License-Identifier: Apache-2.0
// Changes of single faces, in the config and in reviews.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"

#include "run/measured_crowd.h"
#include "support/crowd_files.h"
#include "support/expect_error.h"

namespace crowdface {
namespace {

using nlohmann::json;
using testing::crowd_files;
using testing::differing_files;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::plan_lines;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

std::string id_of(const json& line) {
  return line.at("id");
}

class Changes : public ::testing::Test {
 protected:
  Changes() : folder_(crowd()) {
    for (const char* name : {"bob", "braid", "round"}) {
      folder_.folder().write(concat("wear/", name, ".obj"),
                             "v 0 0 1\nv 1 0 1\nv 0 1 1.5\nf 1 2 3\n");
    }
    std::string config = testing::read_text(folder_.config());
    config.replace(config.find("align: none"), 11,
                   "align: none, tags: {ann: [young], bob: [old], cyd: [young]}");
    folder_.folder().write("config.yaml", config);
    testing::run(folder_);
    plain_ = plan_lines(folder_.out());
  }
  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.heads = 6;
    crowd.regions = 2;
    crowd.count = 8;
    crowd.contact_sheet = "{columns: 4, rows: 2, cell: 32}";
    crowd.more =
        "\nattachments:\n"
        "  fitted_to: ann\n"
        "  items: [{name: bob, kind: hair, file: wear/bob.obj, tint: hair},\n"
        "          {name: braid, kind: hair, file: wear/braid.obj, tint: hair},\n"
        "          {name: round, kind: glasses, file: wear/round.obj, moves: rigid}]\n"
        "  none: {glasses: 0.5}\n"
        "groups: [{name: elderly, share: 0, tags: [old]}]\n"
        "families: [{name: kin, members: 2, max_distance: 10 mm}]\n"
        "recipes: [{id: lead, target: bob}]\n";
    return crowd;
  }
  ConfigOverrides with(const std::string& changes) const {
    ConfigOverrides overrides;
    if (!changes.empty()) overrides.assignments.push_back(concat("changes=", changes));
    return overrides;
  }
  void run(const std::string& changes, const std::string& count = {}) const {
    ConfigOverrides overrides = with(changes);
    if (!count.empty()) overrides.count = count;
    testing::run(folder_, overrides);
  }
  ConfigOverrides with_review(const std::string& name, const std::string& text) const {
    ConfigOverrides overrides;
    overrides.review = {folder_.folder().write(name, "schema: 1\n" + text + "\n").string()};
    return overrides;
  }
  void review(const std::string& name, const std::string& text) const {
    testing::run(folder_, with_review(name, text));
  }
  json line(const std::string& id, const std::string& out = "out") const {
    for (const json& line : plan_lines(folder_ / out)) {
      if (line.at("id") == id) return line;
    }
    return {};
  }
  json before(const std::string& id) const { return *std::ranges::find(plain_, id, id_of); }
  std::vector<std::string> changed_lines() const {
    std::vector<std::string> ids;
    const auto lines = plan_lines(folder_.out());
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      if (lines.at(i) != plain_[i]) ids.push_back(id_of(plain_[i]));
    }
    return ids;
  }
  std::vector<std::string> changed_meshes(const std::map<std::string, std::string>& files) const {
    std::set<std::string> ids;
    for (const std::string& name : differing_files(files, crowd_files(folder_.out()))) {
      const bool is_of_face = name.starts_with("meshes/") ||
                              name.starts_with("gallery/data/faces") ||
                              (name.starts_with("renders/") && !name.starts_with("renders/heads"));
      if (is_of_face) ids.insert(name.substr(0, name.find_first_of("+.")));
    }
    return {ids.begin(), ids.end()};
  }
  /// Millimetres between a face of this plan and another face as it was.
  double mm_between(const std::string& face, const std::string& other) const {
    testing::run_to(folder_, "plain");
    const testing::Measured now(folder_), plain(folder_, "plain");
    const auto at = [](const testing::Measured& crowd, const std::string& id) {
      return static_cast<std::size_t>(std::ranges::find(crowd.lines, id, id_of) -
                                      crowd.lines.begin());
    };
    const std::size_t a = at(now, face), b = at(plain, other);
    return std::min(reference_mm(now, now.as_built[a], plain.as_built[b]),
                    reference_mm(now, now.unit[a], plain.unit[b]));
  }
  static double reference_mm(const testing::Measured& crowd, const reference::Points& a,
                             const reference::Points& b) {
    return reference::distance_mm(crowd.areas, a, b, testing::kMmPerCm);
  }

  SmallCrowdFolder folder_;
  std::vector<json> plain_;
};

TEST_F(Changes, OfAgeAndLooksTouchOneFaceAndAreTold) {
  const auto files = crowd_files(folder_.out());
  run("{mob_0003: {age: older, wears: [braid], hair: red}}");
  EXPECT_THAT(changed_lines(), ElementsAre("mob_0003"));
  EXPECT_THAT(changed_meshes(files), ::testing::Each(::testing::EndsWith("mob_0003")));
  const json face = line("mob_0003");
  EXPECT_EQ(face.at("age"), 0.5);
  EXPECT_THAT(face.at("attachments"), ::testing::Contains("braid"));
  EXPECT_THAT(face.at("attachments"), ::testing::Not(::testing::Contains("bob")));
  EXPECT_GT(face.at("hair").at("pheomelanin").get<double>(), 0.5);
  EXPECT_EQ(face.at("changed"), json({"config: age, wears, hair"}));
  EXPECT_EQ(face.at("target"), before("mob_0003").at("target"));
  const std::string table = testing::read_text(folder_.out() / "crowd.csv");
  EXPECT_THAT(table, ::testing::HasSubstr(",changed"));
  EXPECT_THAT(table, ::testing::HasSubstr("\"config: age, wears, hair\""));

  run("");  // taken back
  EXPECT_THAT(changed_lines(), IsEmpty());
  EXPECT_THAT(changed_meshes(files), IsEmpty());
}

TEST_F(Changes, TakeOffKindsAndAttachmentsOfOneFace) {
  run("{mob_0003: {wears: [braid, round]}}");
  ASSERT_EQ(line("mob_0003").at("attachments"), json({"braid", "round"}));
  run("{mob_0003: {wears: [round], takes_off: [hair]}}");
  EXPECT_EQ(line("mob_0003").at("attachments"), json({"round"}));
  run("{mob_0003: {wears: [braid], takes_off: [round]}}");
  EXPECT_EQ(line("mob_0003").at("attachments"), json({"braid"}));
  EXPECT_EQ(line("mob_0003").at("changed"), json({"config: wears, takes_off"}));
  EXPECT_EQ(line("mob_0003").at("regions"), before("mob_0003").at("regions"));
  EXPECT_THAT(changed_lines(), ElementsAre("mob_0003"));
  run("{mob_kin_02: {takes_off: [hair, glasses]}}");
  EXPECT_THAT(line("mob_kin_02").at("attachments"), IsEmpty());
}

// A change replaces earlier changes of the same key only.
TEST_F(Changes, TakeOffWhatTheConfigPutsOn) {
  ConfigOverrides overrides = with_review("later.yaml", "changes: {mob_0003: {takes_off: [hair]}}");
  overrides.assignments = with("{mob_0003: {wears: [braid, round]}}").assignments;
  testing::run(folder_, overrides);
  EXPECT_EQ(line("mob_0003").at("attachments"), json({"round"}));
  EXPECT_EQ(line("mob_0003").at("changed"), json({"config: wears", "review 1: takes_off"}));
}

TEST_F(Changes, OfTheAgeMoveWeightsToOldHeads) {
  run("{mob_0002: {age: 1}}");
  const json aged = line("mob_0002");
  for (const auto& region : aged.at("regions")) {
    EXPECT_EQ(region.at("weights"), json({{"bob", 1.0}}));
  }
  run("{mob_0002: {wears: []}}");
  EXPECT_THAT(line("mob_0002").at("attachments"), IsEmpty());
  EXPECT_EQ(line("mob_0002").at("regions"), before("mob_0002").at("regions"));
}

TEST_F(Changes, MakeAVariantAtTheAskedDistance) {
  run("{mob_0005: {variant_of: mob_0002, distance: 0.8 mm}}");
  EXPECT_THAT(changed_lines(), ElementsAre("mob_0005"));
  EXPECT_EQ(line("mob_0005").at("target"), before("mob_0002").at("target"));
  EXPECT_NEAR(mm_between("mob_0005", "mob_0002"), 0.8, 0.05);
  EXPECT_EQ(line("mob_0005").at("hair"), before("mob_0002").at("hair"));
}

// The other face's natural hair came back.
TEST_F(Changes, MakeAVariantWithTheChangedHair) {
  const auto is_red = [&](const std::string& id) {
    return line(id).at("hair").at("pheomelanin").get<double>() > 0.5;
  };
  review("a.yaml", "changes: {mob_0002: {hair: red}}");
  ASSERT_TRUE(is_red("mob_0002"));
  review("b.yaml", "changes: {mob_0005: {variant_of: mob_0002}}");
  EXPECT_EQ(line("mob_0005").at("hair"), line("mob_0002").at("hair"));
  review("c.yaml", "changes: {mob_0006: {variant_of: mob_0005}, mob_0002: {hair: blond}}");
  EXPECT_TRUE(is_red("mob_0006"));
  EXPECT_TRUE(is_red("mob_0005"));
  EXPECT_FALSE(is_red("mob_0002"));
}

TEST_F(Changes, AreAvoidedByFacesThatAreCastLater) {
  constexpr double kLeast = 0.6;
  ConfigOverrides overrides;
  overrides.assignments.push_back(concat("diversity.min_distance=", kLeast, " mm"));
  testing::run(folder_, overrides, Replace::kForce);
  overrides.review = {folder_.folder()
                          .write("a.yaml",
                                 "schema: 1\nchanges: {mob_0003: {lock: [region_2]}, "
                                 "mob_0005: {lock: [region_1]}, mob_0006: {variant_of: mob_0001, "
                                 "distance: 1.3 mm}, mob_0007: {lock: [region_1]}}\n")
                          .string()};
  testing::run(folder_, overrides);
  overrides.count = "20";
  overrides.review = {};
  testing::run(folder_, overrides);
  const testing::Measured grown(folder_);
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < grown.lines.size(); ++i) {
    if (!grown.lines[i].contains("changed")) continue;
    for (std::size_t j = 0; j < grown.lines.size(); ++j) {
      const json& index = grown.lines[j].at("index");
      if (index.is_null() || index.get<int>() <= 8) continue;
      nearest = std::min(nearest, grown.between(i, j));
    }
  }
  EXPECT_GE(nearest, kLeast - testing::kTolerance);
}

TEST_F(Changes, OfAReviewAfterMoreReviewsThanThereAreAreRefused) {
  review("a.yaml", "after: 0\nfaces: {mob_0002: reject}");
  testing::expect_error(ExitCode::kUsage,
                        {"b.yaml", "after", "at most 1", "earlier reviews", "found 3"},
                        [&] { review("b.yaml", "after: 3\nfaces: {mob_0003: reject}"); });
  review("b.yaml", "after: 1\nfaces: {mob_0003: reject}");
  run("");  // the kept reviews are read again
}

TEST_F(Changes, LockRegionsAndDrawTheOthersInAGroup) {
  run("{mob_0004: {lock: [region_2], group: elderly}}");
  EXPECT_THAT(changed_lines(), ElementsAre("mob_0004"));
  const json face = line("mob_0004");
  EXPECT_EQ(face.at("regions").at("region_2"), before("mob_0004").at("regions").at("region_2"));
  EXPECT_NE(face.at("regions").at("region_1"), before("mob_0004").at("regions").at("region_1"));
  EXPECT_EQ(face.at("group"), "elderly");
  EXPECT_EQ(face.at("target"), before("mob_0004").at("target"));
  run("{mob_0004: {group: elderly}}");
  EXPECT_EQ(line("mob_0004").at("target"), "bob");
}

TEST_F(Changes, SurviveGrowthAndShards) {
  const std::string changes =
      "{mob_0003: {group: elderly, wears: [bob]}, mob_0006: {variant_of: mob_0001}, "
      "mob_0007: {lock: [region_1], age: 0.3}, mob_kin_01: {age: younger}, lead: {hair: blond}}";
  run(changes);
  EXPECT_THAT(changed_lines(),
              ElementsAre("lead", "mob_kin_01", "mob_0003", "mob_0006", "mob_0007"));
  const auto lines = plan_lines(folder_.out());
  const auto files = crowd_files(folder_.out());
  run(changes, "14");
  const auto more = plan_lines(folder_.out());
  ASSERT_EQ(more.size(), lines.size() + 6);
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(more[i], lines[i]);

  for (int shard = 1; shard <= 2; ++shard) {
    ConfigOverrides overrides = with(changes);
    overrides.out = (folder_ / "shards").string();
    GenerateOptions options{folder_.cache(), Replace::kRefuse, false};
    options.shard = Shard{static_cast<std::uint64_t>(shard), 2};
    generate(folder_.config(), overrides, options);
  }
  ConfigOverrides overrides = with(changes);
  testing::run_to(folder_, "shards", overrides);
  testing::run_to(folder_, "again", overrides);
  EXPECT_THAT(differing_files(crowd_files(folder_ / "again"), crowd_files(folder_ / "shards")),
              IsEmpty());
}

TEST_F(Changes, OfReviewsAddUpAndFollowARedrawnFace) {
  review("a.yaml", "changes: {mob_0002: {age: younger}, mob_0006: {variant_of: mob_0002}}");
  const json young = line("mob_0002"), variant = line("mob_0006");
  EXPECT_EQ(young.at("age"), -0.5);
  EXPECT_EQ(variant.at("changed"), json({"review 1: variant_of"}));
  review("b.yaml", "faces: {mob_0002: reject}\nchanges: {mob_0002: {hair: red}}");
  const json other = line("mob_0002");
  EXPECT_EQ(other.at("age"), -0.5);
  EXPECT_NE(other.at("regions"), young.at("regions"));
  EXPECT_EQ(other.at("changed"), json({"review 1: age", "review 2: hair"}));
  EXPECT_EQ(line("mob_0006"), variant);
  review("c.yaml", "changes: {mob_0002: {age: younger}}");
  EXPECT_EQ(line("mob_0002").at("age"), -1);
  EXPECT_THAT(changed_lines(), ElementsAre("mob_0002", "mob_0006"));

  ConfigOverrides overrides;
  for (int i = 1; i <= 3; ++i) {
    overrides.review.push_back((folder_.out() / concat("reviews/review_00", i, ".yaml")).string());
  }
  testing::run_to(folder_, "again", overrides);
  EXPECT_EQ(plan_lines(folder_ / "again"), plan_lines(folder_.out()));
}

TEST_F(Changes, OfAReviewComeAfterThoseOfTheConfig) {
  review("a.yaml", "changes: {mob_0002: {age: older}}");
  run("{mob_0002: {age: 0.2}}");
  EXPECT_EQ(line("mob_0002").at("age"), 0.7);
  EXPECT_EQ(line("mob_0002").at("changed"), json({"config: age", "review 1: age"}));
}

// The locked region is that of the face that the reviewer saw.
TEST_F(Changes, ARejectedFaceKeepsTheLockedPartsThatAReviewChanged) {
  review("a.yaml", "changes: {mob_0004: {group: elderly}}");
  const json seen = line("mob_0004");
  review("b.yaml", "faces: {mob_0004: {lock: [region_1]}}");
  const json face = line("mob_0004");
  EXPECT_EQ(face.at("regions").at("region_1"), seen.at("regions").at("region_1"));
  EXPECT_NE(face.at("regions").at("region_2"), seen.at("regions").at("region_2"));
  EXPECT_EQ(face.at("group"), "elderly");
}

TEST_F(Changes, OfTheColoursNameHeads) {
  run("{mob_0002: {colours: {cyd: 1, dan: 3}}}");
  EXPECT_THAT(changed_lines(), ElementsAre("mob_0002"));
  EXPECT_EQ(line("mob_0002").at("colours"), json({{"cyd", 0.25}, {"dan", 0.75}}));
}

TEST_F(Changes, OfReviewsMadeAtTheSameTimeAreMerged) {
  review(
      "a.yaml",
      "after: 0\nfaces: {mob_0002: reject, mob_0003: reject, mob_0004: {mark: keep, note: hers}}\n"
      "changes: {mob_0006: {age: older}}");
  const json second = line("mob_0002"), third = line("mob_0003");
  review("b.yaml",
         "after: 0\nfaces: {mob_0002: reject, mob_0003: keep, mob_0004: {mark: keep, note: his}, "
         "mob_0005: reject}\nchanges: {mob_0006: {age: older, hair: red}}");
  EXPECT_EQ(line("mob_0002"), second);
  EXPECT_EQ(line("mob_0003"), third);
  EXPECT_EQ(line("mob_0004").at("note"), "hers; his");
  EXPECT_NE(line("mob_0005"), before("mob_0005"));
  EXPECT_EQ(line("mob_0006").at("age"), 0.5);
  EXPECT_GT(line("mob_0006").at("hair").at("pheomelanin").get<double>(), 0.5);
  const std::string log = testing::read_text(folder_.out() / "crowdface.log");
  EXPECT_THAT(log, ::testing::HasSubstr("mob_0003: review 1 rejects it, review 2 keeps it"));
  EXPECT_THAT(log, ::testing::Not(::testing::HasSubstr("mob_0002: review")));

  review("c.yaml", "after: 2\nfaces: {mob_0002: reject}");  // of the redrawn face
  EXPECT_NE(line("mob_0002").at("regions"), second.at("regions"));
}

TEST_F(Changes, HairColoursThatAgeTurnsGreyAreTold) {
  testing::run(folder_, {"attachments.hair_colours={red: 1}", "sampling.targets=[bob]"},
               Replace::kForce);
  const json report = testing::read_json(folder_.out() / "report.json");
  std::vector<std::string> warnings;
  for (const json& text : report.at("warnings")) warnings.push_back(text);
  EXPECT_THAT(warnings, ::testing::Contains(::testing::ContainsRegex(
                            "attachments.hair_colours.red: .* of them grey with age")));
}

// A quota that no face of a group may wear asks nothing of this group.
TEST_F(Changes, QuotasAskOnlyGroupsThatMayWearTheItem) {
  std::string config = testing::read_text(folder_.config());
  config.replace(config.find("file: wear/braid.obj"), 0, "tags: [young], ");
  config.replace(config.find("none: {glasses: 0.5}"), 20, "quotas: {braid: 0.5}");
  const std::string group = "{name: elderly, share: 0, tags: [old]}";
  config.replace(config.find(group), group.size(),
                 "{name: pupils, share: 0.5, tags: [young]}, "
                 "{name: others, share: 0.5, without: [young]}");
  folder_.folder().write("config.yaml", config);
  testing::run(folder_, std::vector<std::string>(), Replace::kForce);
  const json report = testing::read_json(folder_.out() / "report.json");
  for (const json& text : report.at("warnings")) {
    EXPECT_THAT(text.get<std::string>(), ::testing::Not(::testing::HasSubstr("quotas")));
  }
}

// What tags, quotas, groups and later reviews take precedence over is told, with the faces.
TEST_F(Changes, ThatOverrideOtherKeysAreTold) {
  std::string config = testing::read_text(folder_.config());
  config.replace(config.find("file: wear/braid.obj"), 0, "tags: [old], ");
  config.replace(config.find("none: {glasses: 0.5}"), 20, "quotas: {braid: 0.5}");
  folder_.folder().write("config.yaml", config);
  const auto warnings = [&](const std::string& changes) {
    run(changes);
    std::vector<std::string> texts;
    const json report = testing::read_json(folder_.out() / "report.json");
    for (const json& text : report.at("warnings")) texts.push_back(text);
    return texts;
  };
  const auto has = [](const std::string& text) {
    return ::testing::Contains(::testing::HasSubstr(text));
  };
  testing::run(folder_, std::vector<std::string>(), Replace::kForce);
  const auto worn = [&] {
    int faces = 0;
    for (const json& face : plan_lines(folder_.out())) {
      const auto names = face.at("attachments").get<std::vector<std::string>>();
      faces += !face.at("index").is_null() && std::ranges::count(names, "braid") > 0 ? 1 : 0;
    }
    return faces;
  };
  const int before = worn();
  ASSERT_LT(before, 4);
  EXPECT_THAT(warnings(""), has(concat("attachments.quotas.braid: 4 sampled faces should wear it, ",
                                       before, " do: tags")));
  const std::vector<json> lines = plan_lines(folder_.out());
  const std::string young = id_of(*std::ranges::find_if(lines, [](const json& face) {
    return !face.at("index").is_null() && face.at("target") == "ann";
  }));
  EXPECT_THAT(warnings(concat('{', young, ": {wears: [braid]}}")),
              has(concat("changes: 1 face with attachments whose key tags or without excludes "
                         "the head: ",
                         young, " (braid, ann)")));
  EXPECT_THAT(warnings(concat('{', young, ": {wears: [], hair: red}}")),
              has(concat("changes: 1 face with a hair colour that does not show, because nothing "
                         "worn has a tint: ",
                         young, " (red)")));
  EXPECT_THAT(warnings(concat('{', young, ": {lock: [region_1], group: elderly}}")),
              has(concat("changes: 1 face on a target outside the group, because lock keeps the "
                         "target: ",
                         young, " (ann, elderly)")));
  review("a.yaml", concat("changes: {", young, ": {hair: black}}"));
  EXPECT_THAT(
      warnings(concat('{', young, ": {hair: red}}")),
      has(concat("changes: 1 face whose changes in the config are replaced by those of a review: ",
                 young, " (hair)")));
}

TEST_F(Changes, AreStillThereAfterSheet) {
  run("{mob_0003: {age: older, wears: [braid]}}");
  const auto files = crowd_files(folder_.out());
  remake_sheets(folder_.out(), {}, folder_.cache());
  EXPECT_THAT(differing_files(files, crowd_files(folder_.out())), IsEmpty());
}

TEST_F(Changes, ThatAreWrongAreRefused) {
  const auto refused = [&](const std::string& changes, std::initializer_list<std::string> phrases) {
    testing::expect_error(ExitCode::kUsage, phrases, [&] { run(changes); });
    testing::expect_error(ExitCode::kUsage, phrases, [&] {
      testing::run(folder_, with_review("wrong.yaml", "changes: " + changes));
    });
  };
  refused("{mob_0009: {age: older}}", {"no face of this crowd is called \"mob_0009\""});
  refused("{mob_0001: {age: old}}", {"age", "older, younger or a number"});
  refused("{mob_0001: {ages: older}}", {"ages"});
  refused("{mob_0001: {wears: [brade]}}", {"no attachment is called \"brade\"", "braid"});
  refused("{mob_0001: {wears: [bob, braid]}}", {"braid and bob are both of the kind hair"});
  refused("{mob_0001: {takes_off: [hairs]}}",
          {"no attachment or kind is called \"hairs\"", "hair"});
  refused("{mob_0001: {wears: [bob], takes_off: [hair]}}", {"\"hair\" contradicts wears: [bob]"});
  refused("{mob_0001: {hair: green}}", {"a hair colour"});
  refused("{mob_0001: {variant_of: mob_0010}}", {"mob_0010"});
  refused("{mob_0001: {variant_of: mob_0001}}", {"a face cannot be a variant of itself"});
  refused("{mob_0001: {variant_of: mob_0002, group: elderly}}",
          {"group", "contradicts variant_of"});
  refused("{mob_0001: {distance: 2 mm}}", {"distance", "requires variant_of"});
  refused("{mob_0001: {group: children}}", {"no group is called \"children\""});
  refused("{mob_0001: {lock: [nose]}}", {"no region is called \"nose\""});
  refused("{mob_0001: {}}", {"at least one of age"});
  refused("{mob_kin_01: {group: elderly}}", {"mob_kin_01", "is not a sampled face"});
  testing::expect_error(ExitCode::kUsage, {"wrong.yaml:2:", "ages"}, [&] {
    testing::run(folder_, with_review("wrong.yaml", "changes: {mob_0001: {ages: 1}}"));
  });
  std::string config = testing::read_text(folder_.config());
  config.replace(config.find("file: wear/round.obj"), 0, "excludes: [hair], ");
  folder_.folder().write("config.yaml", config);
  refused("{mob_0001: {wears: [round, braid]}}", {"round excludes braid"});
}

TEST_F(Changes, ThatCannotBeDrawnNameTheFace) {
  ConfigOverrides overrides = with("{mob_0005: {group: elderly}}");  // a group of one head
  overrides.assignments.emplace_back("diversity.min_distance_to_faces=0.01 mm");
  testing::expect_error(ExitCode::kUnsatisfiable,
                        {"mob_0005 cannot be changed: ", "min_distance_to_faces"},
                        [&] { testing::run_to(folder_, "none", overrides); });
}

}  // namespace
}  // namespace crowdface
