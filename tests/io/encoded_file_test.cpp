// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/encoded_file.h"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

EncodedFile three_pieces(const std::string& elsewhere) {
  EncodedFile file;
  file.add("ab");
  file.add_without_copy(elsewhere);
  char* own = file.reserve(10);
  own[0] = 'e';
  file.add_without_copy({own, 1});
  return file;
}

TEST(EncodedFile, IsItsPiecesOneAfterTheOther) {
  const std::string elsewhere = "cd";
  EncodedFile file = three_pieces(elsewhere);
  const EncodedFile moved = std::move(file);
  EXPECT_EQ(moved.text(), "abcde");
  EXPECT_EQ(moved.size(), 5U);
  EXPECT_EQ(moved.digest(), hash_bytes("abcde"));
  const testing::TemporaryFolder folder;
  moved.write(folder / "f");
  EXPECT_EQ(testing::read_text(folder / "f"), "abcde");
}

TEST(EncodedFile, NamesTheFileThatCannotBeWritten) {
  const testing::TemporaryFolder folder;
  const EncodedFile file = three_pieces("");
  testing::expect_error(ExitCode::kCannotCreate, {"nowhere/f"},
                        [&] { file.write(folder / "nowhere/f"); });
  std::filesystem::create_directories(folder / "taken/inside");
  testing::expect_error(ExitCode::kCannotCreate, {"taken"}, [&] { file.write(folder / "taken"); });
}

/// While it lives, no file grows beyond this size: a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*old_handler_)(int) = nullptr;
};

TEST(EncodedFile, LeavesNothingOfAFileThatDoesNotFit) {
  const testing::TemporaryFolder folder;
  const std::string elsewhere(10'000, 'x');
  const EncodedFile file = three_pieces(elsewhere);
  for (const rlim_t bytes : {0U, 1U, 5'000U, 10'002U}) {
    const FileSizeLimit limit(bytes);
    testing::expect_error(ExitCode::kIoError, {(folder / "f").string(), "writing"},
                          [&] { file.write(folder / "f"); });
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

}  // namespace
}  // namespace crowdface
