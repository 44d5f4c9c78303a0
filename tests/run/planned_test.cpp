// SPDX-License-Identifier: Apache-2.0
// Runs that take the folder's plan in place of casting the crowd again.
#include "crowdface/run/planned.h"

#include <gtest/gtest.h>

#include "crowdface/core/hash.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

/// All that a line of a plan may have: groups, a family with parents, recipes, mixtures.
SmallCrowd all_kinds() {
  SmallCrowd crowd;
  crowd.heads = 6;
  crowd.regions = 2;
  crowd.count = 6;
  crowd.levels = "basis";
  crowd.bowl.materials = true;
  crowd.contact_sheet = "{columns: 3, rows: 1, cell: 32}";
  crowd.more =
      "groups: [{name: elders, share: 0.5}]\n"
      "families: [{name: smith, members: 2, parents: {mother: bob, father: cyd}, "
      "max_distance: 2 mm, min_distance: 0.3 mm}]\n"
      "recipes: [{id: by_hand, target: ann, regions: {all: {weights: {bob: 1}}}}]\n";
  return crowd;
}

class Planned : public ::testing::Test {
 protected:
  Planned() : folder_(all_kinds()) { folder_.folder().write("heads/bowl.mtl", "newmtl skin\n"); }
  GenerateOptions options(Shard shard, PlanSource from) const {
    return {folder_.cache(), Replace::kRefuse, false, 0, shard, from};
  }
  void run_shard(Shard shard, PlanSource from, const ConfigOverrides& overrides = {}) const {
    generate(folder_.config(), overrides, options(shard, from));
  }
  void run_plan(const ConfigOverrides& overrides = {}) const {
    plan(folder_.config(), overrides, options({}, PlanSource::kFolderOrCasting));
  }
  std::optional<PlannedFaces> faces(const Shard& shard) const {
    return read_planned_faces(load_job(folder_.config(), {}), {folder_.out()}, shard);
  }

  SmallCrowdFolder folder_;
};

TEST_F(Planned, ShardsOfTheFoldersPlanGiveWhatOneRunGives) {
  run_shard({}, PlanSource::kFolderOrCasting);
  const auto whole = testing::crowd_files(folder_.out());
  fs::remove_all(folder_.out());
  run_plan();
  for (const std::uint64_t shard : {3U, 1U, 2U}) run_shard({shard, 3}, PlanSource::kFolder);
  gather(folder_.out(), folder_.cache());
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
}

TEST_F(Planned, FacesReadBackAreThoseThatWereCast) {
  run_plan();
  const Job job = load_job(folder_.config(), {});
  const auto first = faces({1, 2}), second = faces({2, 2});
  ASSERT_TRUE(first && second);
  std::vector<FacePlan> both;
  for (std::size_t i = 0; i < first->faces.size(); ++i) {
    both.push_back(first->faces[i]);
    if (i < second->faces.size()) both.push_back(second->faces[i]);
  }
  EXPECT_EQ(whole_text(annotated_plan_text(both, job.names, job.settings,
                                           head_tags_and_attachment_kinds(job.config))),
            testing::read_text(folder_.out() / "plan.jsonl"));
}

TEST_F(Planned, AnotherPlanIsNotTaken) {
  testing::expect_error(ExitCode::kMissingInput, {"planned.json", "crowdface plan"}, [&] {
    run_shard({1, 2}, PlanSource::kFolder);
  });
  EXPECT_FALSE(fs::exists(folder_.out()));
  run_plan();
  ASSERT_TRUE(faces({1, 2}).has_value());
  const std::string plan = testing::read_text(folder_.out() / "plan.jsonl");
  const std::string mark = testing::read_text(folder_.out() / "planned.json");
  // One number of it altered, a line lost, or marked by others.
  std::string altered = plan;
  const std::size_t at = altered.find("\"iterations\":") + std::string("\"iterations\":").size();
  altered[at] = altered[at] == '1' ? '2' : '1';
  for (const std::string& text : {altered, plan.substr(0, plan.find('\n') + 1), std::string()}) {
    folder_.folder().write("out/plan.jsonl", text);
    EXPECT_FALSE(faces({1, 2}).has_value());
  }
  folder_.folder().write("out/plan.jsonl", plan);
  for (const char* text : {"", "{}", "[1]", R"({"job":3,"files":4})"}) {
    folder_.folder().write("out/planned.json", text);
    EXPECT_FALSE(faces({1, 2}).has_value()) << text;
  }
  folder_.folder().write("out/planned.json", mark);
  EXPECT_TRUE(faces({1, 2}).has_value());
  // Heads that have changed since: the plan is none of theirs.
  folder_.folder().write("heads/bob.obj", "# edited\n" + testing::read_text(folder_.head("bob")));
  EXPECT_FALSE(faces({1, 2}).has_value());
}

/// Another crowd's plan under this one's mark: whoever takes it casts nothing.
class PlanOfOthers : public Planned {
 protected:
  PlanOfOthers() {
    run_plan();
    std::string plan = testing::read_text(folder_.out() / "plan.jsonl");
    auto mark = testing::read_json(folder_.out() / "planned.json");
    const std::string smoothness = R"("smoothness":)";
    const std::size_t at = plan.find(smoothness) + smoothness.size();
    plan.replace(at, plan.find(',', at) - at, "0.515625");
    folder_.folder().write("out/plan.jsonl", plan);
    mark["files"][0]["bytes"] = plan.size();
    mark["files"][0]["hash"] = hash_bytes(plan).hex();
    folder_.folder().write("out/planned.json", mark.dump());
  }
  bool is_still_theirs() const {
    return testing::read_text(folder_.out() / "plan.jsonl").find("0.515625") != std::string::npos;
  }
};

TEST_F(PlanOfOthers, IsTakenByWhoeverGathers) {
  for (const std::uint64_t shard : {1U, 2U}) run_shard({shard, 2}, PlanSource::kFolder);
  gather(folder_.out(), folder_.cache());
  EXPECT_TRUE(is_still_theirs());
  EXPECT_FALSE(fs::exists(folder_.out() / "planned.json"));
}

TEST_F(PlanOfOthers, IsTakenByOneRun) {
  run_shard({}, PlanSource::kFolderOrCasting);
  EXPECT_TRUE(is_still_theirs());
}

TEST_F(PlanOfOthers, IsNotTakenWithForce) {
  generate(folder_.config(), {}, {folder_.cache(), Replace::kForce});
  EXPECT_FALSE(is_still_theirs());
}

// What shards do not read may have been altered since: then the crowd is cast again.
TEST_F(PlanOfOthers, IsNotTakenByOneRunIfAnythingBesideItIsAltered) {
  for (const char* file : {"out/casting.json", "out/founders.jsonl"}) {
    const std::string before = testing::read_text(folder_ / file);
    folder_.folder().write(file, before + " ");
    EXPECT_FALSE(faces({}).has_value()) << file;
    EXPECT_TRUE(faces({1, 2}).has_value()) << file;
    folder_.folder().write(file, before);
  }
  EXPECT_TRUE(faces({}).has_value());
}

TEST_F(Planned, OneRunOfTheFoldersPlanGivesWhatItGivesWithoutOne) {
  run_shard({}, PlanSource::kFolderOrCasting);
  const auto whole = testing::crowd_files(folder_.out());
  fs::remove_all(folder_.out());
  run_plan();
  run_shard({}, PlanSource::kFolderOrCasting);
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
}

// A plan that an older build left kept a table without the columns that exist now.
TEST_F(Planned, OneRunOfTheFoldersPlanWritesTheTableAnew) {
  run_plan();
  const std::string table = testing::read_text(folder_.out() / "crowd.csv");
  folder_.folder().write("out/crowd.csv", "id\r\n");
  run_shard({}, PlanSource::kFolderOrCasting);
  EXPECT_EQ(testing::read_text(folder_.out() / "crowd.csv"), table);
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

// A run that is stopped has left its plan to those that go on.
TEST_F(Planned, AShardThatCastsLeavesItsPlanToOthers) {
  run_shard({1, 2}, PlanSource::kFolderOrCasting);
  run_shard({2, 2}, PlanSource::kFolder);
  EXPECT_TRUE(faces({}).has_value());
}

// A shard without a plan of its own casts, as it always did.
TEST_F(Planned, AShardCastsWhereThePlanIsAltered) {
  run_plan();
  const std::string plan = testing::read_text(folder_.out() / "plan.jsonl");
  folder_.folder().write("out/plan.jsonl", plan.substr(0, plan.find('\n') + 1));
  run_shard({1, 2}, PlanSource::kFolderOrCasting);
  EXPECT_EQ(testing::read_text(folder_.out() / "plan.jsonl"), plan);
}

}  // namespace
}  // namespace crowdface
