// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/interrupt.h"

#include <csignal>

#include <gtest/gtest.h>
#include <unistd.h>

#include "crowdface/core/error.h"

namespace crowdface {
namespace {

/// Work that never looks whether a signal has arrived.
[[noreturn]] void work_for_ever() {
  catch_interrupts();
  ::raise(SIGTERM);
  for (;;) ::pause();
}

TEST(InterruptDeathTest, EndsAProgramThatDoesNotLook) {
  EXPECT_EXIT(work_for_ever(), ::testing::ExitedWithCode(static_cast<int>(ExitCode::kInterrupted)),
              "error: interrupted by a signal; run the same command again");
}

/// The first signal leaves the program time to end by itself.
TEST(InterruptDeathTest, LeavesTheProgramTimeToEnd) {
  const auto end_at_once = [] {
    catch_interrupts();
    ::raise(SIGINT);
    try {
      throw_if_interrupted();
    } catch (const Interrupted& error) {
      ::_exit(static_cast<int>(error.code()));
    }
  };
  EXPECT_EXIT(end_at_once(), ::testing::ExitedWithCode(static_cast<int>(ExitCode::kInterrupted)),
              "^$");
}

}  // namespace
}  // namespace crowdface
