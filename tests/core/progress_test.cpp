// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

TEST(Progress, TellsItsListenerEachStep) {
  std::vector<std::string> told;
  set_progress_listener([&](const std::string& stage, std::size_t done, std::size_t total) {
    told.push_back(concat(stage, ' ', done, '/', total));
  });
  {
    Progress progress("faces", 2);
    progress.step();
    progress.step();
  }
  set_progress_listener({});
  Progress("heads", 1).step();
  EXPECT_THAT(told, ::testing::ElementsAre("faces 0/2", "faces 1/2", "faces 2/2"));
}

/// A stage of 60 steps that needs 24 seconds before its first step announced 24 minutes.
TEST(Progress, DoesNotCountTheTimeBeforeTheFirstStep) {
  double now = 100;
  Progress progress("casting", 60, 1, [&] { return now; });
  EXPECT_EQ(progress.seconds_left(), std::nullopt);
  now += 24;
  progress.step();
  EXPECT_EQ(progress.seconds_left(), std::nullopt);
  for (int i = 0; i < 9; ++i) {
    now += 0.5;
    progress.step();
  }
  EXPECT_NEAR(progress.seconds_left().value(), 50 * 0.5, 1e-9);
}

/// Casting prepares 64 faces together; its steps then follow each other at once.
TEST(Progress, ComparesWholeBursts) {
  double now = 0;
  Progress progress("casting", 640, 64, [&] { return now; });
  for (int batch = 1; batch <= 4; ++batch) {
    now += 10;
    for (int i = 0; i < 64; ++i) {
      progress.step();
      now += 0.001;
      const double left = 10 * (640 - 64 * (batch - 1) - i - 1) / 64.0;
      if (batch > 1) {
        EXPECT_NEAR(progress.seconds_left().value(), left, 0.02 * left);
      }
    }
    if (batch == 1) {
      EXPECT_EQ(progress.seconds_left(), std::nullopt);
    }
  }
}

TEST(Progress, FollowsStepsThatBecomeSlower) {
  double now = 0;
  Progress progress("casting", 1000, 1, [&] { return now; });
  for (int i = 0; i < 100; ++i) {
    now += 0.1;
    progress.step();
  }
  for (int i = 0; i < 100; ++i) {
    now += 1;
    progress.step();
  }
  EXPECT_NEAR(progress.seconds_left().value(), 800, 20);
}

/// The listener needs no lock of its own.
TEST(Progress, TellsOneStepAtATime) {
  std::size_t calls = 0;
  set_progress_listener([&](const std::string&, std::size_t, std::size_t) { ++calls; });
  Progress progress("faces", 500);
  parallel_for_each(500, [&](int) { progress.step(); });
  set_progress_listener({});
  EXPECT_EQ(calls, 501U);
}

}  // namespace
}  // namespace crowdface
