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
