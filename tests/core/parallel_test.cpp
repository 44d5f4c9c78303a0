// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/parallel.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(ParallelBlocks, CoverEachItemOnce) {
  for (const std::ptrdiff_t count : {0, 1, 7, 8, 9, 1000}) {
    std::vector<int> visits(static_cast<std::size_t>(count), 0);
    parallel_blocks(count, 8, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      EXPECT_EQ(begin % 8, 0);
      EXPECT_LE(end - begin, 8);
      for (auto i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    for (const int n : visits) EXPECT_EQ(n, 1);
  }
}

TEST(ParallelSum, IsTheSameForAnyThreadCount) {
  const auto term = [](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double sum = 0;
    for (auto i = begin; i < end; ++i) sum += 1.0 / static_cast<double>(i + 1);
    return sum;
  };
  const double all = parallel_sum(100000, 1000, term);
  const ThreadLimit one(1);
  EXPECT_EQ(parallel_sum(100000, 1000, term), all);
}

TEST(ParallelForEach, HandsExceptionsOn) {
  EXPECT_THROW(parallel_for_each(100,
                                 [](std::ptrdiff_t i) {
                                   if (i == 42) throw std::runtime_error("42");
                                 }),
               std::runtime_error);
}

TEST(ParallelForEach, RunsNoSecondItemWhileOneWaitsForAnInnerLoop) {
  // Heavy items would otherwise pile up, and their memory with them.
  thread_local int depth = 0;
  std::atomic<int> deepest{0};
  parallel_for_each(64, [&](std::ptrdiff_t) {
    ++depth;
    int seen = deepest.load();
    while (seen < depth && !deepest.compare_exchange_weak(seen, depth)) {
    }
    parallel_blocks(1000, 10, [](std::ptrdiff_t, std::ptrdiff_t) {});
    --depth;
  });
  EXPECT_EQ(deepest.load(), 1);
}

// TBB cancels the loops inside a loop's other items when one item throws, and these return as if
// they were done: faces half built or half rendered were written when a run was interrupted.
TEST(ParallelForEach, AnErrorInOneItemLeavesTheLoopsOfOthersWhole) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  std::atomic<int> blocks{0};
  bool second_item_ran = false;
  EXPECT_THROW(
      parallel_for_each(2,
                        [&](std::ptrdiff_t i) {
                          if (i == 0) {
                            while (blocks == 0 && std::chrono::steady_clock::now() < deadline) {
                            }
                            throw std::runtime_error("first item");
                          }
                          second_item_ran = true;
                          parallel_blocks(200, 1, [&](std::ptrdiff_t, std::ptrdiff_t) {
                            ++blocks;
                            std::this_thread::sleep_for(std::chrono::milliseconds(1));
                          });
                        }),
      std::runtime_error);
  EXPECT_EQ(blocks, second_item_ran ? 200 : 0);
}

TEST(ThreadLimit, HoldsWhileItLives) {
  {
    const ThreadLimit one(1);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_GE(thread_count(), 1);
}

TEST(BackgroundTasks, AreAllDoneWhenWaitedForAndMayBeUsedAgain) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    BackgroundTasks tasks;
    std::atomic<int> done = 0;
    for (int round = 1; round <= 3; ++round) {
      for (int i = 0; i < 40; ++i) {
        tasks.run([&] { parallel_for_each(3, [&](std::ptrdiff_t) { ++done; }); });
      }
      std::atomic<int> beside = 0;  // what the caller does meanwhile
      parallel_for_each(50, [&](std::ptrdiff_t) { ++beside; });
      EXPECT_EQ(beside, 50);
      tasks.wait();
      EXPECT_EQ(done, round * 120);
    }
  }
}

TEST(BackgroundTasks, TellTheFirstExceptionAndGoOnAfterwards) {
  BackgroundTasks tasks;
  for (int i = 0; i < 10; ++i) {
    tasks.run([i] {
      if (i % 3 == 1) throw std::runtime_error("no");
    });
  }
  EXPECT_THROW(tasks.wait(), std::runtime_error);
  bool done = false;
  tasks.run([&] { done = true; });
  tasks.wait();
  EXPECT_TRUE(done);
  tasks.run([] { throw std::runtime_error("dropped with the tasks"); });
}

}  // namespace
}  // namespace crowdface
