// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/problems.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace crowdface {
namespace {

TEST(Problems, TheMostBasicKindSetsTheCode) {
  Problems problems;
  problems.add(ExitCode::kBadData, "bad");
  EXPECT_EQ(problems.code(), ExitCode::kBadData);
  problems.add(ExitCode::kMissingInput, "missing");
  EXPECT_EQ(problems.code(), ExitCode::kMissingInput);
  problems.add(ExitCode::kUsage, "usage");
  EXPECT_EQ(problems.code(), ExitCode::kUsage);
  testing::expect_error(ExitCode::kUsage, {"bad\nmissing\nusage"},
                        [&] { problems.throw_if_any(); });
}

TEST(Problems, TellsEachOnce) {
  Problems problems;
  problems.add(ExitCode::kUsage, "same");
  problems.add(ExitCode::kUsage, "same");
  EXPECT_EQ(problems.size(), 1U);
  EXPECT_NO_THROW(Problems().throw_if_any());
}

}  // namespace
}  // namespace crowdface
