// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/memory.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

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

TEST(Memory, PagesAreLaidOnceAndKeepWhatStands) {
  constexpr std::size_t kBytes = (std::size_t{32} << 20U) + 12345;
  std::vector<char> held;
  held.reserve(kBytes);
  const auto faults = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  const long before = faults();
  lay_pages(held.data() + 1, kBytes - 1);
  const long laid = faults();
  held.resize(kBytes, 'x');
  // Where the system knows how, what is written afterwards finds its pages there.
  if (laid > before + 1000) {
    EXPECT_LT(faults(), laid + 100);
  }
  lay_pages(held.data() + 4095, kBytes - 4095);
  EXPECT_EQ(std::ranges::count(held, 'x'), static_cast<std::ptrdiff_t>(kBytes));
  lay_pages(held.data(), 0);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they allocate by themselves
TEST(Memory, LargeBlocksGoBackEvenAfterLargerOnesWereFreed) {
  give_back_large_blocks();
  constexpr std::size_t kMiB = std::size_t{1} << 20U;
  const auto allocate = [](std::size_t size) {
    void* volatile block = std::malloc(size);  // volatile: not to be left out
    return block;
  };
  std::free(allocate(16 * kMiB));  // makes glibc keep up to that much, unless told otherwise
  const auto mapped = [] { return static_cast<std::size_t>(::mallinfo2().hblkhd); };
  const std::size_t before = mapped();
  void* const block = allocate(4 * kMiB);
  EXPECT_GE(mapped(), before + 4 * kMiB);
  std::free(block);
  EXPECT_EQ(mapped(), before);
}
#endif

// A run said that it was done although a library had caught this and drawn a sheet without letters.
TEST(MemoryRanOut, KnowsWhatSomebodyElseCaught) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's operator new ends the program";
#endif
  watch_for_lack_of_memory();
  EXPECT_FALSE(memory_ran_out());
  EXPECT_THROW(::operator delete(::operator new (std::size_t{1} << 62)), std::bad_alloc);
  EXPECT_TRUE(memory_ran_out());
}

}  // namespace
}  // namespace crowdface
