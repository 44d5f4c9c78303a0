// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "crowdface/core/text.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/crowd/status_text.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

/// A folder of seven faces, f_1 to f_7.
class Status : public ::testing::Test {
 protected:
  Status() {
    folder_.write("config.yaml", "");
    std::string plan;
    for (int face = 1; face <= 7; ++face) plan += concat(R"({"id":"f_)", face, "\",\"index\":1}\n");
    folder_.write("plan.jsonl", plan);
  }
  void write_ledger(const std::string& name, const std::vector<int>& faces) const {
    std::string text = format_ledger_line({"config.yaml", {}, {}, {}}) + "\n";
    for (const int face : faces) {
      text += format_ledger_line({concat("faces/f_", face), {}, {}, {}}) + "\n";
    }
    folder_.write(name, text);
  }
  CrowdStatus status() const { return crowd_status(folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(Status, CountsEachShardsFacesInAllLedgers) {
  write_ledger("ledger-1of3.jsonl", {1, 4});
  write_ledger("ledger-2of3.jsonl", {2, 2});
  write_ledger("ledger.jsonl", {3, 5});  // a whole run's, before
  const CrowdStatus found = status();
  EXPECT_EQ(found.face_count, 7U);
  EXPECT_EQ(found.finished_face_count, 5U);
  ASSERT_EQ(found.shards.size(), 3U);
  EXPECT_EQ(found.shards[0].face_count, 3U);
  EXPECT_EQ(found.shards[0].finished_face_count, 2U);
  EXPECT_EQ(found.shards[1].finished_face_count, 2U);
  EXPECT_EQ(found.shards[1].state, ShardState::kDone);
  EXPECT_EQ(found.shards[2].face_count, 2U);
  EXPECT_EQ(found.shards[2].finished_face_count, 1U);
  EXPECT_EQ(found.shards[2].state, ShardState::kWaiting);
  EXPECT_FALSE(found.is_report_written);
}

// A line that is being written has no end yet.
TEST_F(Status, AHalfLineIsNoFace) {
  write_ledger("ledger-1of2.jsonl", {1});
  const std::string text = testing::read_text(folder_ / "ledger-1of2.jsonl");
  folder_.write("ledger-1of2.jsonl", text.substr(0, text.size() - 1));
  EXPECT_EQ(status().finished_face_count, 0U);
}

TEST_F(Status, PaceAndTimeLeftAreThoseOfShardsAtWork) {
  write_ledger("ledger-1of2.jsonl", {1, 3});
  folder_.write("progress-1of2.json",
                format_shard_notes({ShardState::kWorking, 4, 2, 1, 0.5, "node7", ""}));
  const CrowdStatus found = status();
  const ShardStatus& shard = found.shards.front();
  EXPECT_EQ(shard.state, ShardState::kWorking);
  EXPECT_DOUBLE_EQ(shard.faces_a_second.value(), 2);
  EXPECT_DOUBLE_EQ(shard.seconds_left.value(), 1);
  EXPECT_DOUBLE_EQ(found.seconds_left.value(), 1);
  EXPECT_LT(shard.seconds_since_write.value(), 60);
  EXPECT_THAT(format_status_table(found), HasSubstr("node7"));
  EXPECT_THAT(format_status_table(found), Not(HasSubstr("nothing written")));
}

TEST_F(Status, AKilledShardIsKnownByItsSilence) {
  folder_.write("progress-1of2.json",
                format_shard_notes({ShardState::kWorking, 4, 0, 0, 0, "node7", ""}));
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(folder_ / "progress-1of2.json", now - std::chrono::hours(2));
  EXPECT_NEAR(status().shards.front().seconds_since_write.value(), 7200, 60);
  EXPECT_THAT(format_status_table(status()), HasSubstr("nothing written for 2 h"));
}

TEST_F(Status, TheReasonOfAFailureIsTold) {
  folder_.write("progress-1of2.json",
                format_shard_notes({ShardState::kFailed, 4, 0, 0, 0, "a\xC2\x9B", "disk full"}));
  folder_.write("submit/job.json", R"({"shards":2})");
  folder_.write("submit/log/blend-2.log",
                "=== blend 2, attempt 1\nerror: no heads\n=== ended with code 66\n");
  folder_.write("submit/log/plan-1.log", "=== plan 1\n=== ended with code 0\n");
  folder_.write("submit/log/prepare-3.log", "=== prepare\nerror: x\n=== ended with code 74\n");
  const CrowdStatus found = status();
  EXPECT_EQ(found.shards[0].reason, "disk full");
  EXPECT_EQ(found.shards[1].state, ShardState::kFailed);
  EXPECT_EQ(found.shards[1].reason, "no heads");
  EXPECT_EQ(found.failures, std::vector<std::string>{"prepare-3: ended with code 74: x"});
  const std::string text = format_status_json(found);
  EXPECT_EQ(printable(text), text) << "it would be escaped once more, and be no JSON";
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["shards"][0]["machine"], "a\xC2\x9B");
  EXPECT_EQ(json["shards"][1]["reason"], "no heads");
  EXPECT_EQ(json["shards"][0]["state"], "failed");
}

TEST_F(Status, ANewAttemptForgetsTheLastOnesEnd) {
  const std::string failed = "=== blend 1, attempt 1\nerror: full\n=== ended with code 74\n";
  EXPECT_EQ(parse_task_end(failed).exit_code, 74U);
  EXPECT_EQ(parse_task_end(failed).reason, "full");
  EXPECT_FALSE(parse_task_end(failed + "=== blend 1, attempt 2\n").exit_code.has_value());
  EXPECT_TRUE(parse_task_end(failed + "=== blend 1, attempt 2\n").reason.empty());
  EXPECT_FALSE(parse_task_end("").exit_code.has_value());
}

TEST_F(Status, ATaskThatSlurmRunsAgainIsRequeued) {
  const std::string again = "=== blend 2, attempt 1\n=== ended with code 75\n=== requeued\n";
  folder_.write("submit/job.json", R"({"shards":2})");
  folder_.write("submit/log/blend-2.log", again);
  folder_.write("submit/log/plan-1.log", "=== plan 1\n=== ended with code 75\n=== requeued\n");
  EXPECT_THAT(format_status_table(status()), HasSubstr("2/2    requeued"));
  EXPECT_THAT(format_status_json(status()), HasSubstr(R"("state":"requeued")"));
  EXPECT_TRUE(status().failures.empty()) << "a stage that runs again has not failed";
  folder_.write("submit/log/blend-2.log", again + "=== blend 2, attempt 2\n");
  EXPECT_FALSE(status().shards[1].is_requeued) << "it runs";
  folder_.write("submit/log/blend-2.log", again + "=== ended with code 75\n");
  EXPECT_FALSE(status().shards[1].is_requeued) << "Slurm refused";
}

TEST_F(Status, NotesOfOthersSayNothing) {
  for (const char* text : {"", "[]", "{}", R"({"state":"flying","faces":1})", "\xff",
                           R"({"state":"done","faces":-1,"done":0,"made":0,"seconds":0,
                               "machine":"","reason":""})"}) {
    folder_.write("progress-1of2.json", text);
    const CrowdStatus found = status();
    EXPECT_EQ(found.shards.front().state, ShardState::kWaiting) << text;
    EXPECT_EQ(found.face_count, 7U);
  }
  folder_.write("submit/job.json", R"({"shards":123456789})");
  EXPECT_EQ(status().shards.size(), 2U);
}

TEST(StatusOfNothing, IsRefused) {
  const TemporaryFolder folder;
  testing::expect_error(ExitCode::kMissingInput, {"config.yaml", "the folder of a crowd"},
                        [&] { crowd_status(folder.path()); });
}

}  // namespace
}  // namespace crowdface
