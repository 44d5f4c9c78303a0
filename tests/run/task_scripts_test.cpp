// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/task_scripts.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crowdface/core/text.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using testing::read_text;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;
using testing::TemporaryFolder;

/// Tasks whose program notes its arguments and ends with a code.
class Tasks : public ::testing::Test {
 protected:
  Tasks() {
    job_.directory.root = folder_ / "it's $HOME";
    job_.program =
        folder_.write("a \"program\"", concat("#!/bin/sh\nprintf '%s|' \"$@\" >>'",
                                              (folder_ / "said").string(), "'\nexit ${CODE:-0}\n"));
    std::filesystem::permissions(job_.program, std::filesystem::perms::owner_all);
    job_.config_arguments = {"/c o.yaml", "--set", "a='b'"};
    job_.crowd_name = "mob";
    job_.cache = folder_ / "cache";
    job_.prepare_task_count = 2;
    job_.shard_count = 7;
    job_.processor_count = 3;
  }
  int run(const std::string& before, const std::string& arguments) const {
    const std::string command = before + " bash \"" + folder_.path().string() +
                                "/it's \\$HOME/submit/task.sh\" " + arguments;
    return WEXITSTATUS(std::system(command.c_str()));  // NOLINT(concurrency-mt-unsafe)
  }
  std::string said() const { return read_text(folder_ / "said"); }

  TemporaryFolder folder_;
  TaskJob job_;
};

TEST_F(Tasks, EachStageIsACommandWithItsPart) {
  job_.memory_bytes = std::uint64_t{8} << 30U;
  write_task_scripts(job_, JobEngine::kSlurm, {});
  const std::string end = concat("--cache|", job_.cache.string(), "|--threads|3|");
  const std::string memory = "--memory|7340032 KiB|";
  EXPECT_EQ(run("", "prepare 2"), 0);
  EXPECT_EQ(run("", "plan"), 0);
  EXPECT_EQ(run("SLURM_ARRAY_TASK_ID=5", "blend"), 0);
  EXPECT_EQ(run("", "gather 1"), 0);
  EXPECT_EQ(said(),
            concat("prepare|/c o.yaml|--set|a='b'|--shard|2/2|", end, "plan|/c o.yaml|--set|a='b'|",
                   memory, end, "generate|/c o.yaml|--set|a='b'|--planned|--shard|5/7|", memory,
                   end, "gather|", job_.directory.root.string(), "|", end));
  EXPECT_EQ(run("", "dance 1"), 64);
}

TEST_F(Tasks, EndWithTheProgramsCodeAndSaySo) {
  write_task_scripts(job_, JobEngine::kParallel, {});
  EXPECT_EQ(run("CODE=74", "blend 3"), 74);
  EXPECT_THAT(read_text(job_.directory.cluster_task_folder() / "log/blend-3.log"),
              ::testing::AllOf(::testing::HasSubstr("=== blend 3, attempt 1"),
                               ::testing::HasSubstr("=== ended with code 74\n")));
}

TEST_F(Tasks, UseTheMachinesOwnCopyOfTheCacheIfItCanBeMade) {
  job_.scratch_folder = "$OWN";
  folder_.write("cache/a.cfcache", "head");
  write_task_scripts(job_, JobEngine::kSlurm, {});
  EXPECT_EQ(run(concat("OWN=", (folder_ / "own").string()), "blend 1"), 0);
  const std::string own = concat((folder_ / "own/crowdface-cache-").string(), ::getuid());
  EXPECT_THAT(said(), ::testing::HasSubstr(concat("--cache|", own, "|")));
  EXPECT_EQ(read_text(own + "/a.cfcache"), "head");
  folder_.write("file", "");
  EXPECT_EQ(run(concat("OWN=", (folder_ / "file").string()), "blend 1"), 0);
  EXPECT_THAT(said(), ::testing::HasSubstr(concat("--cache|", job_.cache.string(), "|")));
}

TEST_F(Tasks, SlurmGetsTheSitesOptionsAndChainsTheStages) {
  job_.memory_bytes = 1'000'000'000;
  const auto script = write_task_scripts(job_, JobEngine::kSlurm,
                                         {"long", "2:00", 90, {}, {"--account=it's ours"}});
  const std::string text = read_text(script);
  for (const char* part :
       {"'--partition=long'", "'--time=2:00'", "'--mem=954M'", "'--signal=B:TERM@90'",
        "'--cpus-per-task=3'", R"('--account=it'\''s ours')", "afterany:", "--requeue"}) {
    EXPECT_THAT(text, ::testing::HasSubstr(part));
  }
}

TEST(FittingTasks, GrowWithTheCrowdAndAreNeverMoreThanItsFaces) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{cell: 256}";
  const SmallCrowdFolder folder(crowd);
  const Job job = load_job(folder.config(), {});
  EXPECT_EQ(suitable_shard_count(job.config, job.inputs, 1, 1), 1U);
  EXPECT_EQ(suitable_shard_count(job.config, job.inputs, 0, 1), 1U);
  const std::uint64_t many = suitable_shard_count(job.config, job.inputs, 1'000'000, 1);
  EXPECT_GT(many, 10U);
  EXPECT_NEAR(static_cast<double>(many),
              8.0 * static_cast<double>(suitable_shard_count(job.config, job.inputs, 1'000'000, 8)),
              8);
  EXPECT_EQ(suitable_shard_count(job.config, job.inputs, 1'000'000'000, 1), 1000U);
  EXPECT_EQ(suitable_prepare_task_count(job.inputs, 1), 1U);
}

}  // namespace
}  // namespace crowdface
