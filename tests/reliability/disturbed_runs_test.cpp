// SPDX-License-Identifier: Apache-2.0
// Runs that are killed, signalled, or whose system calls fail, and what the next run makes of them.
#include <cerrno>
#include <csignal>
#include <random>

#include <sys/resource.h>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Kind = Fault::Kind;

class Disturbed : public DisturbedCrowd {};

/// Each part has an eighth of the tried calls.
constexpr std::uint64_t kParts = 8;
class FailingCall : public DisturbedCrowd, public ::testing::WithParamInterface<std::uint64_t> {};

// Test 2 of docs/reliability.md.
TEST_P(FailingCall, IsToldAndTheNextRunGoesOn) {
  ASSERT_GT(undisturbed_.calls, 100U);
  RecordProperty("calls", static_cast<int>(undisturbed_.calls));
  const auto every =
      static_cast<std::uint64_t>(times(3, 1));  // try every third call, or every call
  int told = 0;
  for (std::uint64_t call = every * GetParam(); call < undisturbed_.calls; call += every * kParts) {
    for (const int error : {EIO, ENOSPC}) {
      if (error == ENOSPC && call / (every * kParts) % 4 != 0) continue;
      const std::string what = concat("call ", call, " failed with ", error);
      fs::remove_all(folder_.out());
      const ChildOutcome outcome = run({Kind::kFail, call, error});
      ASSERT_TRUE(outcome.code == 0 || outcome.code == 73 || outcome.code == 74)
          << what << ": " << outcome.code << ' ' << outcome.message;
      if (outcome.code == 0) {
        fs::remove(folder_.out() / ".crowdface.lock");  // its removal may be what failed: harmless
        EXPECT_THAT(differences(), ::testing::IsEmpty()) << what;
        continue;
      }
      ++told;
      EXPECT_THAT(outcome.message, ::testing::HasSubstr(folder_.out().string())) << what;
      for (const auto& [name, bytes] : files()) {
        EXPECT_EQ(name.find(".tmp"), name.npos) << what << " left " << name;
      }
      expect_resumed(what);
    }
  }
  EXPECT_GT(told, static_cast<int>(undisturbed_.calls / (every * kParts)) / 2);
}

INSTANTIATE_TEST_SUITE_P(Eighths, FailingCall, ::testing::Range(std::uint64_t{0}, kParts));

// Test 1.
TEST_F(Disturbed, KilledAtAnyCallTheNextRunGoesOn) {
  std::mt19937 random(1);
  for (int i = 0; i < times(50, 1000); ++i) {
    constexpr Kind kKinds[] = {Kind::kKillBefore, Kind::kKillWithin, Kind::kKillAfter};
    const Fault fault{kKinds[i % 3], random() % undisturbed_.calls, 0};
    fs::remove_all(folder_.out());
    const ChildOutcome outcome = run(fault);
    EXPECT_EQ(outcome.code, outcome.struck ? -SIGKILL : 0) << fault.at;
    expect_resumed(concat("killed at call ", fault.at));
  }
}

// A crowd whose runs are killed again and again, each later than the last, gets done.
TEST_F(Disturbed, KilledManyTimesItGetsThere) {
  std::mt19937 random(2);
  const auto longest_step = static_cast<std::uint64_t>(times(20, 10));
  std::uint64_t at = 0;
  const auto run_longer = [&] {
    at += 1 + random() % longest_step;
    return run({Kind::kKillAfter, at, 0});
  };
  int kills = 0;
  ChildOutcome last = run_longer();
  for (; last.code == -SIGKILL && at < 4 * undisturbed_.calls; last = run_longer()) ++kills;
  EXPECT_GE(kills, 3);
  EXPECT_EQ(last.code, 0) << "after " << kills << " kills: " << last.message;
  EXPECT_THAT(differences(), ::testing::IsEmpty()) << "after " << kills << " kills";
}

// Test 16.
TEST_F(Disturbed, ASignalAtAnyCallIs75AndTheNextRunGoesOn) {
  fault_signals_ = true;
  std::mt19937 random(3);
  int stopped = 0;
  const int count = times(50, 500);
  for (int i = 0; i < count; ++i) {
    constexpr int kSignals[] = {SIGTERM, SIGINT, SIGHUP, SIGXCPU};
    const Fault fault{Kind::kSignal, random() % undisturbed_.calls, kSignals[i % 4]};
    fs::remove_all(folder_.out());
    const ChildOutcome outcome = run(fault);
    EXPECT_TRUE(outcome.code == 75 || outcome.code == 0) << outcome.code << outcome.message;
    if (outcome.code == 75) {
      ++stopped;
      EXPECT_THAT(outcome.message, ::testing::HasSubstr("run the same command again"));
    }
    expect_resumed(concat("signal at call ", fault.at));
  }
  EXPECT_GT(stopped, count / 5);
}

// Test 3, as the kernel tells of a full disk.
TEST_F(Disturbed, AFullDiskIsNeverDone) {
  std::uint64_t steps = 0;
  const std::uint64_t step = undisturbed_.written / static_cast<std::uint64_t>(times(40, 400)) + 1;
  for (std::uint64_t room = 0; room < undisturbed_.written; room += step, ++steps) {
    fs::remove_all(folder_.out());
    const ChildOutcome outcome = run({Kind::kDiskFull, room, 0});
    EXPECT_TRUE(outcome.code == 73 || outcome.code == 74) << room << ": " << outcome.code;
    EXPECT_THAT(outcome.message, ::testing::HasSubstr(folder_.out().string()));
    if (steps % 4 == 0) expect_resumed(concat("disk full after ", room, " bytes"));
  }
}

TEST_F(Disturbed, ShortWritesAreGoneOnWith) {
  EXPECT_EQ(run({Kind::kShortWrites, 0, 0}).code, 0);
  EXPECT_THAT(differences(), ::testing::IsEmpty());
}

TEST_F(Disturbed, AFileSizeLimitIsToldNotDiedOf) {
  for (rlim_t size = 1; size < 60'000; size = size * 3 / 2 + 1) {
    fs::remove_all(folder_.out());
    const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
      std::signal(SIGXFSZ, SIG_IGN);  // as main does
      rlimit limit{size, size};
      if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("no limit");
      generate_here();
    });
    bool fits = true;
    for (const auto& [name, bytes] : whole_) fits = fits && bytes.size() <= size;
    if (fits) continue;
    EXPECT_TRUE(outcome.code == 73 || outcome.code == 74) << size << ": " << outcome.code;
    EXPECT_THAT(outcome.message, ::testing::HasSubstr(folder_.out().string()));
  }
  expect_resumed("file size limits");
}

/// Test 3 for each format alone.
class FullDisk : public DisturbedCrowd, public ::testing::WithParamInterface<std::string> {
 protected:
  FullDisk() : DisturbedCrowd(small(), {"output.meshes=[" + GetParam() + "]"}) {}
};

TEST_P(FullDisk, IsNeverDone) {
  const std::uint64_t step = undisturbed_.written / 7 + 1;
  for (std::uint64_t room = 0; room < undisturbed_.written; room += step) {
    fs::remove_all(folder_.out());
    const ChildOutcome outcome = run({Kind::kDiskFull, room, 0});
    EXPECT_TRUE(outcome.code == 73 || outcome.code == 74) << room << ": " << outcome.code;
  }
  expect_resumed("a full disk");
}

INSTANTIATE_TEST_SUITE_P(Formats, FullDisk, ::testing::Values("obj", "ply", "glb", "points"),
                         [](const auto& format) { return format.param; });

}  // namespace
}  // namespace crowdface::testing
