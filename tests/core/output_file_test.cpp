// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "crowdface/core/file.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

TEST(OutputFile, IsWhatThePathNames) {
  const TemporaryFolder folder;
  EXPECT_EQ(checked_output_path(folder / "new.obj"), folder / "new.obj");
  folder.write("old.obj", "x");
  EXPECT_EQ(checked_output_path(folder / "old.obj"), folder / "old.obj");
  EXPECT_EQ(checked_output_path("new.obj"), "new.obj");
}

TEST(OutputFile, IsWhereALinkLeads) {
  const TemporaryFolder folder;
  folder.write("elsewhere/old.obj", "x");
  fs::create_symlink("elsewhere/old.obj", folder / "latest.obj");
  fs::create_symlink("elsewhere/new.obj", folder / "next.obj");
  const fs::path elsewhere = fs::canonical(folder / "elsewhere");
  EXPECT_EQ(checked_output_path(folder / "latest.obj"), elsewhere / "old.obj");
  testing::expect_error(ExitCode::kCannotCreate, {"next.obj"},  // leads nowhere yet
                        [&] { checked_output_path(folder / "next.obj"); });
}

// A device or a pipe was replaced by a file: /dev/null itself, for a user who may.
TEST(OutputFile, IsNothingButARegularFile) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "folder");
  fs::create_symlink("folder", folder / "link");
  fs::create_symlink("circle", folder / "circle");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder / "link_to_pipe");
  for (const char* name : {"folder", "link", "circle", "pipe", "link_to_pipe", "", "no/new.obj"}) {
    testing::expect_error(ExitCode::kCannotCreate, {name},
                          [&] { checked_output_path(folder / name); });
  }
  testing::expect_error(ExitCode::kCannotCreate, {"/dev/null"},
                        [] { checked_output_path("/dev/null"); });
  testing::expect_error(ExitCode::kCannotCreate, {"expected the name"},
                        [] { checked_output_path(""); });
  for (const char* name : {"folder", "pipe"}) {
    testing::expect_error(ExitCode::kCannotCreate, {name, "regular file"},
                          [&] { write_file(folder / name, "x"); });
  }
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

// Whoever reads a pipe waits for its writer.
TEST(ReadFile, DoesNotWaitForAPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  testing::expect_error(ExitCode::kMissingInput, {"pipe: expected a regular file"},
                        [&] { read_file(folder / "pipe"); });
}

}  // namespace
}  // namespace crowdface
