// SPDX-License-Identifier: Apache-2.0
// A crowd that is reviewed, grows, and changes its formats and single faces, by runs that are killed
// again and again.
#include <csignal>
#include <random>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Kind = Fault::Kind;

class DisturbedReviews : public ::testing::Test {
 protected:
  DisturbedReviews() : folder_(small()) {
    encode_png(1, 1, 1, std::vector<std::uint8_t>(1));  // see DisturbedCrowd
  }

  static SmallCrowd small() {
    SmallCrowd crowd;
    crowd.heads = 6;
    crowd.bowl.materials = true;
    crowd.count = 3;
    crowd.contact_sheet = "{columns: 2, rows: 2, cell: 32}";
    return crowd;
  }

  ChildOutcome run(const fs::path& out, const Fault& fault,
                   const std::vector<std::string>& reviews) const {
    return run_with_fault(out, fault, [&] {
      const ThreadLimit limit(2);
      ConfigOverrides overrides;
      overrides.set = {concat("output.meshes=", formats_)};
      if (!changes_.empty()) overrides.set.push_back(concat("changes=", changes_));
      overrides.count = std::to_string(count_);
      overrides.out = out.string();
      overrides.review = reviews;
      generate(folder_.config(), overrides, {folder_.cache(), Replace::kRefuse, false});
    });
  }

  /// The crowd that a run from nothing makes with the same config and the kept reviews.
  ChildOutcome make_anew() const {
    std::vector<std::string> kept;
    for (const fs::path& file : CrowdDirectory{folder_.out()}.kept_reviews()) {
      kept.push_back(file.string());
    }
    fs::remove_all(folder_ / "anew");
    return run(folder_ / "anew", {}, kept);
  }

  static std::string id_of(int face) {
    return concat("mob_", zero_padded(static_cast<std::uint64_t>(face), 4));
  }

  /// "mob_0003: {variant_of: mob_0001}" of another face.
  std::string some_variant(int face) {
    const int other = 1 + static_cast<int>(random_() % static_cast<unsigned>(count_ - 1));
    return concat(id_of(face), ": {variant_of: ", id_of(other < face ? other : other + 1), '}');
  }

  std::string write_review(int number) {
    std::vector<std::string> marks, changes;
    for (int face = 1; face <= count_; ++face) {
      const std::string id = id_of(face);
      if (random_() % 4 == 0) changes.push_back(some_variant(face));
      if (random_() % 3 == 0) marks.push_back(id + ": reject");
      if (random_() % 5 == 1 && (marks.empty() || !marks.back().starts_with(id))) {
        marks.push_back(concat(id, ": {mark: keep, note: \"by ", number, "\"}"));
      }
    }
    return folder_.folder()
        .write(concat("review_", number, ".yaml"),
               concat("schema: 1\nfaces: {", join(marks), "}\nchanges: {", join(changes), "}\n"))
        .string();
  }

  SmallCrowdFolder folder_;
  std::mt19937 random_{4};
  int count_ = 3;
  std::string formats_ = "[obj]";
  std::string changes_;  ///< of the config; empty: none
};

TEST_F(DisturbedReviews, AfterEachStepTheCrowdIsThatOfARunFromNothing) {
  std::uint64_t calls = 200;
  int kills = 0, reviews = 0;
  for (int step = 0; step < times(10, 100); ++step) {
    std::vector<std::string> given;
    switch (random_() % 4) {
      case 0:
        count_ += 1 + static_cast<int>(random_() % 2);
        break;
      case 1:
        formats_ = formats_ == "[obj]" ? "[ply, obj]" : "[obj]";
        break;
      case 2:
        changes_ = changes_.empty() ? concat('{', some_variant(2), '}') : "";
        break;
      default:
        given = {write_review(++reviews)};
    }
    if (random_() % 4 == 0) count_ += 1;  // together with a review or a format
    const std::string what = concat("step ", step, ", count ", count_, ", reviews ", reviews);
    constexpr Kind kKinds[] = {Kind::kKillBefore, Kind::kKillWithin, Kind::kKillAfter};
    for (int kill = 0; kill < 3; ++kill) {
      const ChildOutcome killed =
          run(folder_.out(), {kKinds[random_() % 3], random_() % calls, 0}, given);
      ASSERT_EQ(killed.code, killed.struck ? -SIGKILL : 0) << what << ": " << killed.message;
      kills += killed.struck ? 1 : 0;
    }
    const ChildOutcome done = run(folder_.out(), {}, given);
    ASSERT_EQ(done.code, 0) << what << ": " << done.message;
    ASSERT_EQ(CrowdDirectory{folder_.out()}.kept_reviews().size(),
              static_cast<std::size_t>(reviews))
        << what;
    const ChildOutcome anew = make_anew();
    ASSERT_EQ(anew.code, 0) << what << ": " << anew.message;
    calls = anew.calls;
    EXPECT_THAT(differing_files(crowd_files(folder_ / "anew"), crowd_files(folder_.out())),
                ::testing::IsEmpty())
        << what;
  }
  EXPECT_GE(reviews, 2);
  EXPECT_GE(kills, 10);
}

}  // namespace
}  // namespace crowdface::testing
