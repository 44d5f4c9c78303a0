// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/generate_run.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(RunProgress, IsReadFromTheLastLine) {
  const RunProgress progress =
      read_progress("info: reading heads: 4 in 0.1 s\ninfo: building: 12/24, 3.00/s, 4.0 s left\n");
  EXPECT_EQ(progress.done, 12U);
  EXPECT_EQ(progress.total, 24U);
  EXPECT_DOUBLE_EQ(progress.seconds_left, 4);
  EXPECT_EQ(progress.message, "building: 12/24, 3.00/s, 4.0 s left");
}

TEST(RunProgress, OtherLinesAreMessages) {
  EXPECT_EQ(read_progress("").message, "");
  for (const char* line : {"error: a/b.obj: cannot be read", "info: a/b left", "info: / left",
                           "info: 3/x, y/s, z left"}) {
    const RunProgress progress = read_progress(line);
    EXPECT_EQ(progress.total, 0U) << line;
    EXPECT_EQ(progress.seconds_left, 0) << line;
    EXPECT_FALSE(progress.message.empty()) << line;
  }
}

}  // namespace
}  // namespace crowdface
