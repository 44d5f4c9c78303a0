// SPDX-License-Identifier: Apache-2.0
#include "cli/program_test.h"
#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

TEST(Submit, PrintWritesScriptsAndSubmitsNothing) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const fs::path script = folder.out() / "submit/submit.sh";
  const Outcome outcome =
      crowdface(0, {"submit", folder.config().string(), "--print", "--shards", "3", "--time",
                    "1-02:00:00", "--seed", "5", "--cache", folder.cache().string()});
  EXPECT_EQ(outcome.out, script.string() + "\n");
  EXPECT_THAT(read_text(script), ::testing::HasSubstr("shards=3"));
  EXPECT_THAT(read_text(folder.out() / "submit/task.sh"), ::testing::HasSubstr("'--seed' '5'"));
  crowdface(0, {"status", folder.out().string()}, {"not planned yet", "3/3", "waiting"});
  crowdface(0, {"status", folder.out().string(), "--json"}, {"\"shards\":[{\"shard\":1,\"of\":3"});
}

// Heads that only a --limit admits were refused by every task.
TEST(Submit, GivesLimitsToEveryTask) {
  const SmallCrowdFolder folder(SmallCrowd{});
  crowdface(0, {"submit", folder.config().string(), "--print", "--limit", "vertices=70000000",
                "--limit", "textures=5"});
  const std::string script = read_text(folder.out() / "submit/task.sh");
  EXPECT_THAT(script, ::testing::HasSubstr(
                          "limits=('--limit' 'vertices=70000000' '--limit' 'textures=5')\n"));
  EXPECT_THAT(script, ::testing::HasSubstr("\"${command[@]}\" \"${limits[@]}\" --cache"));
}

TEST(Submit, RefusesWhatCannotBeMeant) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const auto refused = [&](const std::vector<std::string>& options, const char* phrase) {
    std::vector<std::string> arguments = {"submit", folder.config().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    crowdface(64, arguments, {phrase});
  };
  refused({"--engine", "pbs"}, "slurm or parallel");
  refused({"--shards", "0"}, "--shards");
  refused({"--shards", "10000"}, "9999");
  refused({"--prepare-tasks", "x"}, "--prepare-tasks");
  refused({"--processors", "0"}, "--processors");
  refused({"--memory", "8"}, "4 GiB");
  refused({"--time", "tomorrow"}, "--time");
  refused({"--grace", "0"}, "--grace");
  refused({"--engine", "parallel", "--time", "5"}, "--time: only --engine slurm");
  refused({"--host", "a"}, "--host: only --engine parallel");
  refused({"--set", "crowd.count=0.5"}, "crowd.count");
  EXPECT_FALSE(fs::exists(folder.out()));
}

TEST(Submit, WritesNothingBehindALinkThatLeadsOutOfTheCrowd) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const fs::path elsewhere = folder / "elsewhere";
  for (const char* link : {"submit", "submit/log"}) {
    fs::create_directories(elsewhere);
    fs::create_directories((folder.out() / link).parent_path());
    fs::create_directory_symlink(elsewhere, folder.out() / link);
    crowdface(73, {"submit", folder.config().string(), "--print"},
              {"submit", "a link that leads out"});
    EXPECT_TRUE(fs::is_empty(elsewhere));
    fs::remove_all(folder.out());
  }
}

TEST(Status, OfNoCrowdIs66) {
  const SmallCrowdFolder folder(SmallCrowd{});
  crowdface(66, {"status", (folder / "heads").string()}, {"the folder of a crowd"});
  crowdface(64, {"status", folder.out().string(), "--every", "2"}, {"--watch"});
}

TEST(Prepare, AShardOfTheHeadsIsKept) {
  SmallCrowd crowd;
  crowd.levels = "basis";
  const SmallCrowdFolder folder(crowd);
  const auto entries = [&] {
    return std::distance(fs::directory_iterator(folder.cache()), fs::directory_iterator());
  };
  const auto prepare = [&](const char* shard) {
    crowdface(0, {"prepare", folder.config().string(), "--cache", folder.cache().string(),
                  "--shard", shard});
  };
  prepare("2/3");
  EXPECT_EQ(entries(), 1);  // of four heads the second
  prepare("1/3");
  EXPECT_EQ(entries(), 3);
  prepare("3/3");
  crowdface(0, {"prepare", folder.config().string(), "--cache", folder.cache().string()},
            {"4 of 4 prepared heads came from the cache"});
}

}  // namespace
}  // namespace crowdface::testing
