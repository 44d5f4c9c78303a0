// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/block_shelf.h"

#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kSize = std::size_t{3} << 20U;

class BlockShelf : public ::testing::Test {
 protected:
  BlockShelf() { give_back_large_blocks(); }  // as programs do
};

TEST_F(BlockShelf, KeepsNothingUnlessAsked) {
  take_block(kSize);
  EXPECT_EQ(kept_block_bytes(), 0U);
}

TEST_F(BlockShelf, GivesABlockToTheNextOfItsSize) {
  const KeptBlocks kept(10 * kSize);
  const char* const first = take_block(kSize).get();
  EXPECT_EQ(kept_block_bytes(), kSize);
  const auto smaller = take_block(kSize / 2);
  EXPECT_NE(smaller.get(), first) << "half of it would lie idle";
  const auto again = take_block(kSize - 100);
  EXPECT_EQ(again.get(), first);
  EXPECT_EQ(kept_block_bytes(), 0U);
  const auto other = take_block(kSize);
  EXPECT_NE(other.get(), first) << "it is in use";
}

TEST_F(BlockShelf, HoldsItsLimitWithThoseInUse) {
  const KeptBlocks kept(2 * kSize);
  auto a = take_block(kSize), b = take_block(kSize), c = take_block(kSize);
  a.reset();
  EXPECT_EQ(kept_block_bytes(), 0U) << "two are in use";
  b.reset();
  EXPECT_EQ(kept_block_bytes(), kSize);
  c.reset();
  EXPECT_EQ(kept_block_bytes(), 2 * kSize);
}

TEST_F(BlockShelf, FreesWhatIsKeptAtTheEndAndWhatIsInUseLater) {
  std::shared_ptr<char[]> held;
  {
    const KeptBlocks kept(10 * kSize);
    held = take_block(kSize);
    take_block(kSize);
    EXPECT_EQ(kept_block_bytes(), kSize);
  }
  EXPECT_EQ(kept_block_bytes(), 0U);
  std::memset(held.get(), 1, kSize);
  held.reset();
  EXPECT_EQ(kept_block_bytes(), 0U);
}

TEST_F(BlockShelf, NoTwoThreadsHoldTheSame) {
  const KeptBlocks kept(100 * kSize);
  std::vector<int> spoilt(200, 0);
  parallel_for_each(spoilt.size(), [&](std::size_t i) {
    const auto block = take_block(kSize);
    std::memset(block.get(), static_cast<int>(i % 251), kSize);
    for (std::size_t at = 0; at < kSize; at += 4096) {
      if (block[static_cast<std::ptrdiff_t>(at)] != static_cast<char>(i % 251)) spoilt[i] = 1;
    }
  });
  for (const int one : spoilt) EXPECT_EQ(one, 0);
}

}  // namespace
}  // namespace crowdface
