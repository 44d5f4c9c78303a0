// SPDX-License-Identifier: Apache-2.0
// Test 14 of docs/reliability.md: several runs on one folder.
#include <csignal>
#include <random>

#include <unistd.h>

#include "crowdface/core/file_lock.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"

#include "reliability/crowd_under_test.h"
#include "support/program.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Kind = Fault::Kind;

class SharedFolder : public DisturbedCrowd {
 protected:
  void generate_shard(const Shard& shard) const {
    const ThreadLimit limit(1);
    GenerateOptions options{folder_.cache(), Replace::kRefuse, false};
    options.shard = shard;
    generate(folder_.config(), {}, options);
  }
};

TEST_F(SharedFolder, RunsAtTheSameTimeLeaveTheSameCrowd) {
  for (int i = 0; i < times(7, 150); ++i) {
    const auto runs = static_cast<std::size_t>(2 + i % 7);
    fs::remove_all(folder_.out());
    const std::vector<Child> children(runs, {{}, [this] { generate_here(); }});
    for (const ChildOutcome& outcome : run_together(folder_.out(), children)) {
      EXPECT_EQ(outcome.code, 0) << outcome.message;
    }
    EXPECT_THAT(differences(), ::testing::IsEmpty()) << runs << " runs";
  }
}

TEST_F(SharedFolder, TheLockOfAKilledRunIsNoLock) {
  std::mt19937 random(5);
  for (int i = 0; i < times(5, 50); ++i) {
    fs::remove_all(folder_.out());
    const auto work = [this] { generate_here(); };
    const Fault fault{Kind::kKillBefore, 5 + random() % (undisturbed_.calls - 5), 0};
    const auto outcomes = run_together(folder_.out(), {{fault, work}, {{}, work}, {{}, work}});
    EXPECT_EQ(outcomes[1].code, 0) << outcomes[1].message;
    EXPECT_EQ(outcomes[2].code, 0) << outcomes[2].message;
    // The killed one may have come last: then its lock's file is there until another run.
    EXPECT_EQ(run_with_fault(folder_.out(), {}, work).code, 0);
    EXPECT_THAT(differences(), ::testing::IsEmpty()) << "killed at call " << fault.at;
  }
}

TEST_F(SharedFolder, ShardsAtTheSameTimeOneOfThemKilled) {
  std::mt19937 random(6);
  for (int i = 0; i < times(5, 50); ++i) {
    fs::remove_all(folder_.out());
    constexpr std::uint64_t kShards = 3;
    std::vector<Child> children;
    for (std::uint64_t shard = 1; shard <= kShards; ++shard) {
      children.push_back({{}, [this, shard] { generate_shard({shard, kShards}); }});
    }
    children.push_back(children[1]);  // the same shard twice
    children[0].fault = {Kind::kKillAfter, 5 + random() % 60, 0};
    const auto outcomes = run_together(folder_.out(), children);
    for (std::size_t c = 1; c < outcomes.size(); ++c) {
      EXPECT_EQ(outcomes[c].code, 0) << c << ": " << outcomes[c].message;
    }
    const auto again = run_with_fault(folder_.out(), {}, [&] { generate_shard({1, kShards}); });
    EXPECT_EQ(again.code, 0) << again.message;
    const auto gathered =
        run_with_fault(folder_.out(), {}, [&] { gather(folder_.out(), folder_.cache()); });
    EXPECT_EQ(gathered.code, 0) << gathered.message;
    EXPECT_THAT(differences(), ::testing::IsEmpty());
  }
}

TEST_F(SharedFolder, WaitingEndsAtASignal) {
  fault_signals_ = true;
  const FileLock lock(
      [this] {
        fs::create_directories(folder_.out());
        return CrowdDirectory{folder_.out()}.lock();
      }(),
      LockKind::kExclusive, {});
  const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [this] {
    ::alarm(2);
    std::signal(SIGALRM, [](int) { ::raise(SIGTERM); });
    generate_here();
  });
  EXPECT_EQ(outcome.code, 75) << outcome.message;
  EXPECT_FALSE(fs::exists(folder_.out() / "plan.jsonl"));
}

// The lock's file was looked at twice; where the run before removed it between the two, this one ended with 73.
TEST_F(SharedFolder, ALockThatVanishesIsNoObstacle) {
  fs::create_directories(folder_.out());
  const fs::path lock = CrowdDirectory{folder_.out()}.lock();
  folder_.folder().write("out/.crowdface.lock", "");
  const Outcome outcome = run_program(
      "/usr/bin/env", {concat("LD_PRELOAD=", CROWDFACE_LIBRARY_FAULTS), "FAULT_CALL=none",
                       "FAULT_VANISHES=" + lock.string(), CROWDFACE_PROGRAM, "generate", "-q",
                       folder_.config().string(), "--cache", folder_.cache().string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(differences(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace crowdface::testing
