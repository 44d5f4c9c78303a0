// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/memory.h"

#include <cstdlib>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crowdface/core/text.h"

#include "support/temporary_folder.h"

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
  EXPECT_EQ(format_bytes(1 << 20), "1 MiB");
}

// A limit of 100,000 bytes was called "0 MiB".
TEST(FormatBytes, NamesSizesBelowAMebibyteInSmallerUnits) {
  EXPECT_EQ(format_bytes((1 << 20) - 1), "1024 KiB");
  EXPECT_EQ(format_bytes(100'000), "98 KiB");
  EXPECT_EQ(format_bytes(1024), "1 KiB");
  EXPECT_EQ(format_bytes(1023), "1023 bytes");
  EXPECT_EQ(format_bytes(0), "0 bytes");
}

TEST(MachineMemory, IsPlausible) {
  EXPECT_GT(usable_memory_bytes(), 64ULL << 20);
  EXPECT_LT(usable_memory_bytes(), 1ULL << 50);
}

using testing::TemporaryFolder;

// The limit of the outermost group was read, which Slurm and systemd never set: a run planned with three quarters of
// the node and was killed.
TEST(MemoryLimitOfGroups, IsTheLeastOfTheProcessGroupAndThoseItLiesIn) {
  const TemporaryFolder folder;
  const auto limit = [&](const std::string& groups) {
    return control_group_memory_limit_bytes(folder.write("cgroup", groups), folder.path());
  };
  EXPECT_EQ(limit("0::/"), std::nullopt);
  std::filesystem::create_directories(folder / "slurm/job_7/step_0");
  std::filesystem::create_directories(folder / "memory/job/step");
  folder.write("slurm/job_7/memory.max", "4096\n");
  folder.write("slurm/job_7/step_0/memory.max", "max\n");
  folder.write("slurm/memory.max", "8192\n");
  EXPECT_EQ(limit("0::/slurm/job_7/step_0\n"), 4096U) << "of the group above";
  EXPECT_EQ(limit("0::/slurm\n"), 8192U);
  EXPECT_EQ(limit("0::/elsewhere\n"), std::nullopt);
  EXPECT_EQ(limit("0::/../slurm/job_7\n"), std::nullopt) << "outside of what is shown";
  folder.write("memory/job/step/memory.limit_in_bytes", "2048\n");
  folder.write("memory/job/memory.limit_in_bytes", "3072\n");
  EXPECT_EQ(limit("9:name=systemd:/job/step\n3:cpu,memory:/job/step\n0::/\n"), 2048U);
  EXPECT_EQ(limit("4:memory:/job\n0::/slurm/job_7\n"), 3072U) << "of both versions";
  EXPECT_EQ(limit("3:cpu:/job/step\n"), std::nullopt);
  folder.write("memory.max", "1024\n");
  EXPECT_EQ(limit("0::/slurm/job_7\n"), 1024U) << "of the outermost";
  EXPECT_EQ(control_group_memory_limit_bytes(folder / "nothing", folder.path()), 1024U);
}

/// A group below that of this process, with a limit; empty where the machine allows none.
std::filesystem::path make_group(std::uint64_t bytes) {
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::string name = concat("crowdface_test_", ::getpid());
    const auto made = [&](const std::filesystem::path& folder, const char* file) {
      std::error_code error;
      if (!std::filesystem::create_directory(folder, error)) return false;
      std::ofstream limit(folder / file);
      limit << bytes << std::flush;
      if (limit) return true;
      std::filesystem::remove(folder, error);
      return false;
    };
    const std::string group = line.substr(line.rfind(':') + 1);
    auto second = std::filesystem::path("/sys/fs/cgroup" + group) / name;
    auto first = std::filesystem::path("/sys/fs/cgroup/memory" + group) / name;
    if (line.starts_with("0::") && made(second, "memory.max")) return second;
    if (line.find(":memory:") != line.npos && made(first, "memory.limit_in_bytes")) return first;
  }
  return {};
}

TEST(MachineMemory, IsTheLimitOfANestedGroup) {
  constexpr std::uint64_t kLimit = 256ULL << 20;
  const std::filesystem::path group = make_group(kLimit);
  if (group.empty()) GTEST_SKIP() << "no control group can be made here";
  const pid_t child = ::fork();
  if (child == 0) {
    std::ofstream(group / "cgroup.procs") << ::getpid() << std::flush;
    std::_Exit(usable_memory_bytes() == kLimit ? 0 : 1);
  }
  int status = 1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  std::error_code ignored;
  EXPECT_TRUE(std::filesystem::remove(group, ignored)) << ignored.message();
}

TEST(PeakMemory, GrowsWithWhatIsHeld) {
  constexpr std::uint64_t kMore = 64ULL << 20;
  const std::uint64_t before = peak_memory_bytes();
  std::vector<char> held(kMore, 1);
  EXPECT_EQ(held[kMore / 2], 1);
  EXPECT_GE(peak_memory_bytes(), before);
  EXPECT_GE(peak_memory_bytes(), kMore);
  EXPECT_LE(peak_memory_bytes(), usable_memory_bytes());
}

// A run said that it was done although a library had caught this and drawn a sheet without letters.
TEST(MemoryRanOut, KnowsWhatSomebodyElseCaught) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's operator new ends the program";
#endif
  watch_for_out_of_memory();
  EXPECT_FALSE(is_out_of_memory());
  EXPECT_THROW(::operator delete(::operator new (std::size_t{1} << 62)), std::bad_alloc);
  EXPECT_TRUE(is_out_of_memory());
}

}  // namespace
}  // namespace crowdface
