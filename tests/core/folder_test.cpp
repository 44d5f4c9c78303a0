// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

TEST(ListFolder, NamesComeInOrderAndWhatIsNoFolderHasNone) {
  const TemporaryFolder folder;
  for (const char* name : {"in/b", "in/a", "in/.hidden", "in/sub/c"}) folder.write(name, "");
  const fs::path in = folder / "in";
  EXPECT_THAT(list_folder(in), ElementsAre(in / ".hidden", in / "a", in / "b", in / "sub"));
  EXPECT_THAT(list_folder(folder / "none"), IsEmpty());
  EXPECT_THAT(list_folder(in / "a"), IsEmpty());
  std::error_code error;
  EXPECT_THAT(list_folder(in / "sub", &error), ElementsAre(in / "sub/c"));
  EXPECT_FALSE(error);
  EXPECT_THAT(list_folder(folder / "none", &error), IsEmpty());
  EXPECT_EQ(error, std::errc::no_such_file_or_directory);
  EXPECT_THAT(list_folder(in / "a", &error), IsEmpty());
  EXPECT_EQ(error, std::errc::not_a_directory);
}

TEST(FoldersFrom, LinksAreNotFollowed) {
  const TemporaryFolder folder;
  folder.write("in/sub/deep/c", "");
  folder.write("out/d", "");
  fs::create_directory_symlink(folder / "out", folder / "in/link");
  const fs::path in = folder / "in";
  EXPECT_THAT(folder_tree(in), ElementsAre(in, in / "sub", in / "sub/deep"));
}

TEST(LeadsBelow, LinksAreSeenThrough) {
  const TemporaryFolder folder;
  folder.write("in/a", "");
  folder.write("out/d", "");
  fs::create_directory_symlink(folder / "out", folder / "in/link");
  fs::create_directory_symlink(folder / "in", folder / "in/self");
  const fs::path in = folder / "in";
  EXPECT_TRUE(is_inside_folder(in / "a", in));
  EXPECT_TRUE(is_inside_folder(in / "not/there/yet", in));
  EXPECT_TRUE(is_inside_folder(in / "self/a", in));
  EXPECT_FALSE(is_inside_folder(in / "link/d", in));
  EXPECT_FALSE(is_inside_folder(in / "../out/d", in));
  EXPECT_TRUE(is_inside_folder("a", "")) << "the working directory";
  EXPECT_FALSE(is_inside_folder(in / "a", ""));
}

TEST(DirectoryHandle, ASecondFolderOfItsNameIsAnother) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "in");
  const DirectoryHandle held(folder / "in");
  EXPECT_NO_THROW(held.require_still_at_path());
  fs::rename(folder / "in", folder / "moved");
  EXPECT_THROW(held.require_still_at_path(), IoError);
  fs::create_directories(folder / "in");
  EXPECT_THROW(held.require_still_at_path(), IoError);
  EXPECT_THROW(DirectoryHandle(folder / "none"), CannotCreate);
}

}  // namespace
}  // namespace crowdface
