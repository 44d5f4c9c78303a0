// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/cancel.h"

#include <atomic>

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

TEST(Cancel, StopsLoopsUntilWorkIsAllowed) {
  const auto count = [] {
    std::atomic<int> calls = 0;
    parallel_for_each(1000, [&](int) { ++calls; });
    return calls.load();
  };
  EXPECT_FALSE(is_interrupted());
  cancel_work();
  EXPECT_TRUE(is_interrupted());
  EXPECT_THROW(count(), Interrupted);
  end_cancellation();
  EXPECT_FALSE(is_interrupted());
  EXPECT_EQ(count(), 1000);
}

}  // namespace
}  // namespace crowdface
