// SPDX-License-Identifier: Apache-2.0
// A crowd that is reviewed, grows, gets nearer faces, and changes its formats and single faces, by
// runs that are killed again and again.
#include <csignal>
#include <random>

#include "crowdface/core/text.h"
#include "crowdface/run/crowd_sheets.h"

#include "reliability/crowd_under_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Kind = Fault::Kind;

class ReviewedCrowd {
 public:
  explicit ReviewedCrowd(unsigned seed) : folder_(small()), random_(seed) {
    encode_png(1, 1, 1, std::vector<std::uint8_t>(1));  // see DisturbedCrowd
    for (const char* name : {"bob", "braid", "round"}) {
      folder_.folder().write(concat("wear/", name, ".obj"),
                             "v 0 0 1\nv 1 0 1\nv 0 1 1.5\nf 1 2 3\n");
    }
    folder_.folder().write("points.yaml", "template: {nose_wing_left: 53, nose_wing_right: 56}\n");
    std::string config = read_text(folder_.config());
    config.replace(config.find("align: none"), 11,
                   "align: none, tags: {ann: [young], bob: [old], cyd: [young], dan: [old]}");
    folder_.folder().write("config.yaml", config);
  }

  /// Does something with the crowd, by runs that are killed before one is not.
  void step(const std::string& where) {
    std::vector<std::string> given;
    bool shards = false, sheet = false;
    switch (random_() % 8) {
      case 0:
        count_ += 1 + static_cast<int>(random_() % 2);
        break;
      case 1:
        formats_ = formats_ == "[obj]" ? "[ply, obj]" : "[obj]";
        break;
      case 2:
        changes_ = changes_.empty() ? concat('{', some_change(2), '}') : "";
        break;
      case 3:
        min_distance_mm_ *= 0.8;
        break;
      case 4:
        shards = true;
        break;
      case 5:
        sheet = true;
        break;
      default:
        given = {write_review()};
    }
    if (random_() % 4 == 0) count_ += 1;  // together with a review or a format
    const std::string what = concat(where, ", count ", count_, ", reviews ", reviews);
    if (shards) {
      for (const std::uint64_t shard : {1U, 2U}) {
        run_killed({}, Shard{shard, 2}, what);
      }
      run_and_expect(what, [&] { gather(folder_.out(), folder_.cache()); });
    } else {
      run_killed(given, {}, what);
    }
    if (sheet) run_and_expect(what, [&] { remake_sheets(folder_.out(), {}, folder_.cache()); });
    ASSERT_EQ(CrowdDirectory{folder_.out()}.stored_reviews().size(),
              static_cast<std::size_t>(reviews))
        << what;
    const ChildOutcome anew = make_anew();
    ASSERT_EQ(anew.code, 0) << what << ": " << anew.message;
    calls_ = anew.calls;
    EXPECT_THAT(differing_files(crowd_files(folder_ / "anew"), crowd_files(folder_.out())),
                ::testing::IsEmpty())
        << what;
  }

  int kills = 0, reviews = 0;

 private:
  static SmallCrowd small() {
    SmallCrowd crowd;
    crowd.heads = 6;
    crowd.regions = 2;
    crowd.bowl.materials = true;
    crowd.count = 3;
    crowd.contact_sheet = "{columns: 2, rows: 2, cell: 32}";
    crowd.more =
        "\nlandmarks: points.yaml\n"
        "attachments:\n"
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

  ChildOutcome run(const fs::path& out, const Fault& fault, const std::vector<std::string>& given,
                   const Shard& shard, const std::vector<std::string>& set = {}) const {
    return run_with_fault(out, fault, [&] {
      const ThreadLimit limit(2);
      ConfigOverrides overrides;
      overrides.assignments = {
          concat("output.meshes=", formats_),
          concat("diversity.min_distance=", format_fixed(min_distance_mm_, 4), " mm")};
      if (!changes_.empty()) overrides.assignments.push_back(concat("changes=", changes_));
      overrides.assignments.insert(overrides.assignments.end(), set.begin(), set.end());
      overrides.count = std::to_string(count_);
      overrides.out = out.string();
      overrides.review = given;
      GenerateOptions options{folder_.cache(), Replace::kRefuse, false};
      options.shard = shard;
      generate(folder_.config(), overrides, options);
    });
  }

  void run_killed(const std::vector<std::string>& given, const Shard& shard,
                  const std::string& what) {
    constexpr Kind kKinds[] = {Kind::kKillBefore, Kind::kKillWithin, Kind::kKillAfter};
    for (int kill = 0; kill < (shard.is_whole_crowd() ? 3 : 1); ++kill) {
      const Kind kind = kKinds[random_() % 3];
      const std::uint64_t call = random_() % calls_;
      const ChildOutcome killed = run(folder_.out(), {kind, call, 0}, given, shard);
      ASSERT_EQ(killed.code, killed.struck ? -SIGKILL : 0) << what << ": " << killed.message;
      kills += killed.struck ? 1 : 0;
    }
    const ChildOutcome done = run(folder_.out(), {}, given, shard);
    ASSERT_EQ(done.code, 0) << what << ": " << done.message;
  }

  void run_and_expect(const std::string& what, const std::function<void()>& work) const {
    const ChildOutcome done = run_with_fault(folder_.out(), {}, work);
    ASSERT_EQ(done.code, 0) << what << ": " << done.message;
  }

  /// The crowd that a run from nothing makes with the same config, the smallest distances in the
  /// folder's config, and the kept reviews.
  ChildOutcome make_anew() const {
    std::vector<std::string> kept, set;
    for (const fs::path& file : CrowdDirectory{folder_.out()}.stored_reviews()) {
      kept.push_back(file.string());
    }
    const std::string config = read_text(folder_.out() / "config.yaml");
    const std::string key = "min_distance_of_first: ";
    if (const std::size_t at = config.find(key); at != config.npos) {
      const std::size_t begin = at + key.size();
      set.push_back(concat("diversity.min_distance_of_first=",
                           config.substr(begin, config.find('\n', begin) - begin)));
    }
    fs::remove_all(folder_ / "anew");
    return run(folder_ / "anew", {}, kept, {}, set);
  }

  static std::string id_of(int face) {
    return concat("mob_", zero_padded(static_cast<std::uint64_t>(face), 4));
  }

  /// "mob_0003: {variant_of: mob_0001}" or another change.
  std::string some_change(int face) {
    const int other = 1 + static_cast<int>(random_() % static_cast<unsigned>(count_ - 1));
    const std::string variant =
        concat("{variant_of: ", id_of(other < face ? other : other + 1), ", distance: 0.5 mm}");
    const std::vector<std::string> changes = {
        variant,
        variant,
        "{age: older}",
        "{age: -0.4, hair: red}",
        "{wears: [braid, round]}",
        "{wears: []}",
        "{takes_off: [hair]}",
        "{hair: white, age: younger}",
        "{colours: {ann: 1, cyd: 3}}",
        "{group: elderly}",
        "{lock: [region_1]}",
        "{traits: {nose_width: {at_most: 60 %}}}",
        "{traits: {nose_width: [40 %, 90 %]}, hair: red}",
        "{traits: {nose_width: {at_least: 30 %}}, age: older}",
        "{lock: [region_2], group: elderly, age: older}"};
    return concat(id_of(face), ": ", changes[random_() % changes.size()]);
  }

  std::string write_review() {
    std::vector<std::string> marks, changes;
    for (int face = 1; face <= count_; ++face) {
      const std::string id = id_of(face);
      if (random_() % 4 == 0) changes.push_back(some_change(face));
      if (random_() % 4 == 0) {
        marks.push_back(id + (random_() % 3 == 0 ? ": {lock: [region_2]}" : ": reject"));
      } else if (random_() % 5 == 1) {
        marks.push_back(concat(id, ": {mark: keep, note: \"by ", reviews, "\"}"));
      }
    }
    if (random_() % 3 == 0) changes.emplace_back("mob_kin_01: {age: older}");
    if (random_() % 3 == 0) changes.emplace_back("lead: {hair: blond, wears: [round]}");
    const std::string after =
        random_() % 3 == 0 ? concat("after: ", std::max(0, reviews - 1), '\n') : "";
    ++reviews;
    return folder_.folder()
        .write(concat("review_", reviews, ".yaml"),
               concat("schema: 1\n", after, "faces: {", join(marks), "}\nchanges: {", join(changes),
                      "}\n"))
        .string();
  }

  SmallCrowdFolder folder_;
  std::mt19937 random_;
  int count_ = 3;
  double min_distance_mm_ = 0.2;
  std::uint64_t calls_ = 200;
  std::string formats_ = "[obj]";
  std::string changes_;  ///< of the config; empty: none
};

TEST(DisturbedReviews, AfterEachStepTheCrowdIsThatOfARunFromNothing) {
  int kills = 0, reviews = 0;
  for (int seed = 0; seed < times(1, 40); ++seed) {
    ReviewedCrowd crowd(static_cast<unsigned>(seed));
    for (int step = 0; step < 12 && !::testing::Test::HasFailure(); ++step) {
      crowd.step(concat("seed ", seed, ", step ", step));
    }
    kills += crowd.kills;
    reviews += crowd.reviews;
  }
  EXPECT_GE(reviews, 2);
  EXPECT_GE(kills, 10);
}

}  // namespace
}  // namespace crowdface::testing
