// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/memory.h"

#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(ParseBytes, ReadsSizesWithTheirUnit) {
  EXPECT_EQ(parse_bytes("4 GiB"), 4ULL << 30);
  EXPECT_EQ(parse_bytes("512MiB"), 512ULL << 20);
  EXPECT_EQ(parse_bytes("1.5 kB"), 1500U);
  EXPECT_EQ(parse_bytes("2 TB"), 2'000'000'000'000U);
  for (const char* bad : {"", "4", "GiB", "-1 GiB", "4 gib", "1e3 MB", "4 GiB x", "99999999 TiB"}) {
    EXPECT_EQ(parse_bytes(bad), std::nullopt) << bad;
  }
}

TEST(FormatBytes, IsShort) {
  EXPECT_EQ(format_bytes(3435973837), "3.2 GiB");
  EXPECT_EQ(format_bytes(49283072), "47 MiB");
}

TEST(MachineMemory, IsPlausible) {
  EXPECT_GT(machine_memory(), 64ULL << 20);
  EXPECT_LT(machine_memory(), 1ULL << 50);
}

TEST(PeakMemory, GrowsWithWhatIsHeld) {
  constexpr std::uint64_t kMore = 64ULL << 20;
  const std::uint64_t before = peak_memory();
  std::vector<char> held(kMore, 1);
  EXPECT_EQ(held[kMore / 2], 1);
  EXPECT_GE(peak_memory(), before);
  EXPECT_GE(peak_memory(), kMore);
  EXPECT_LE(peak_memory(), machine_memory());
}

}  // namespace
}  // namespace crowdface
