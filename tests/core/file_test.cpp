// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/file.h"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::expect_error;
using testing::read_text;
using testing::TemporaryFolder;

std::size_t entries_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}

TEST(WriteFile, LeavesTheFileAndNothingElse) {
  const TemporaryFolder folder;
  write_file(folder / "a", std::vector<std::string_view>{"one ", "", "two"});
  EXPECT_EQ(read_file(folder / "a"), "one two");
  write_file(folder / "a", "three");
  EXPECT_EQ(read_text(folder / "a"), "three");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(WriteFile, AFailedWriteKeepsTheOldFileAndLeavesNoOther) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 4096;
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string large(100000, 'x');
  expect_error(ExitCode::kIoError, {"a: writing failed"}, [&] { write_file(folder / "a", large); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(read_text(folder / "a"), "old");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(WriteFile, NamesTheFileThatCannotBeCreated) {
  const TemporaryFolder folder;
  expect_error(ExitCode::kCannotCreate, {"missing/a"},
               [&] { write_file(folder.path() / "missing" / "a", "x"); });
}

TEST(WriteFiles, LeaveEachWholeInItsFolder) {
  const TemporaryFolder folder;
  make_directories(folder / "sub");
  std::string large;
  large.resize(20'000'000, 'x');  // written in several pieces
  write_files(std::vector<FileToWrite>{{folder / "a", {"one ", "two"}},
                                       {folder / "sub" / "b", {large, "y"}},
                                       {folder / "sub" / "c", {}}});
  EXPECT_EQ(read_file(folder / "a"), "one two");
  EXPECT_EQ(read_file(folder / "sub" / "b"), large + "y");
  EXPECT_EQ(read_file(folder / "sub" / "c"), "");
  EXPECT_EQ(entries_in(folder / "sub"), 2U);
}

TEST(WriteFiles, OneThatCannotBeCreatedLeavesNoneUnfinished) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  expect_error(ExitCode::kCannotCreate, {"missing"}, [&] {
    write_files(std::vector<FileToWrite>{{folder / "a", {"new"}},
                                         {folder.path() / "missing" / "b", {"new"}}});
  });
  EXPECT_EQ(read_file(folder / "a"), "old");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(ReadFile, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  expect_error(ExitCode::kMissingInput, {"none.obj"}, [&] { read_file(folder / "none.obj"); });
  expect_error(ExitCode::kMissingInput, {"regular file"}, [&] { MappedFile file(folder.path()); });
}

TEST(MappedFile, ShowsTheBytes) {
  const TemporaryFolder folder;
  const MappedFile file(folder.write("a", "bytes"));
  EXPECT_EQ(file.bytes(), "bytes");
  EXPECT_TRUE(MappedFile(folder.write("empty", "")).bytes().empty());
}

TEST(MakeDirectories, RefusesWhereAFileStands) {
  const TemporaryFolder folder;
  folder.write("a", "file");
  expect_error(ExitCode::kCannotCreate, {"a"}, [&] { make_directories(folder / "a"); });
  EXPECT_NO_THROW(make_directories(folder.path() / "b" / "c"));
  // `synth --mask m.png` asked for the folder of a bare name.
  EXPECT_NO_THROW(make_directories(std::filesystem::path("m.png").parent_path()));
}

// Reading a file put a handler of SIGBUS into the host's process, which ended it where a file was cut. (The first
// of these tests: later ones switch the handler on, as the program does.)
TEST(MappedFile, UnwatchedLeavesSignalsToTheHostAndIsACopy) {
  const TemporaryFolder folder;
  const std::string bytes(20'000, 'x');
  const std::filesystem::path path = folder.write("copied", bytes);
  const MappedFile copied(path), filled(path, OnTruncation::kFill);
  struct sigaction action {};
  ASSERT_EQ(::sigaction(SIGBUS, nullptr, &action), 0);
  EXPECT_EQ(action.sa_handler, SIG_DFL);
  ASSERT_EQ(::truncate(path.c_str(), 5000), 0);
  EXPECT_EQ(copied.bytes(), bytes);
  EXPECT_EQ(filled.bytes(), bytes);
  EXPECT_FALSE(filled.was_truncated());
}

TEST(MappedFile, UnwatchedRefusesAFileThatEndsTooSoon) {
  const char* short_one =
      "/sys/kernel/mm/transparent_hugepage/enabled";  // its size is said to be a page
  if (!is_file(short_one)) GTEST_SKIP() << "this system has no such file";
  expect_error(ExitCode::kIoError, {short_one, "was truncated while it was being read"},
               [&] { MappedFile file(short_one); });
}

// The process died of SIGBUS.
TEST(MappedFile, CutWhileItIsMappedItReadsAsZerosAndTellsOrEndsWithAWord) {
  const testing::TemporaryFolder folder;
  const std::string bytes(20'000, 'x');
  const std::filesystem::path path = folder.write("mapped", bytes);
  watch_mapped_files();
  const MappedFile filled(path, OnTruncation::kFill);
  EXPECT_EQ(filled.bytes(), bytes);
  EXPECT_FALSE(filled.was_truncated());
  ASSERT_EQ(::truncate(path.c_str(), 5000), 0);
  EXPECT_TRUE(filled.was_truncated());
  EXPECT_EQ(filled.bytes()[4000], 'x');
  EXPECT_EQ(filled.bytes()[6000], '\0');
  EXPECT_EQ(filled.bytes()[19'999], '\0');
  folder.write("mapped", bytes);
  const auto cut_and_read = [&] {
    const MappedFile mapped(path);
    [[maybe_unused]] const int cut = ::truncate(path.c_str(), 5000);
    std::_Exit(mapped.bytes()[19'999] == 'x' ? 1 : 2);
  };
  EXPECT_EXIT(cut_and_read(), ::testing::ExitedWithCode(74), "mapped: was truncated while");
}

}  // namespace
}  // namespace crowdface
