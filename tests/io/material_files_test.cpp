// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/material_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> names(const MaterialFiles& files) {
  std::vector<std::string> result;
  for (const MaterialFile& file : files.files) result.push_back(file.relative.string());
  return result;
}

TEST(MaterialFiles, FollowLibrariesToTextures) {
  const testing::TemporaryFolder folder;
  folder.write("a.mtl",
               "newmtl skin\nKd 1 1 1\nmap_Kd -s 1 1 1 tex/skin.png\nbump tex\\pores.png\n"
               "map_Ks gone.png\n");
  folder.write("b c.mtl", "newmtl b\n");
  folder.write("tex/skin.png", "x");
  folder.write("tex/pores.png", "x");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl", "b c.mtl"});
  EXPECT_EQ(names(found),
            (std::vector<std::string>{"a.mtl", "tex/skin.png", "tex/pores.png", "b c.mtl"}));
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("gone.png"));
}

TEST(MaterialFiles, NeverLeaveTheFolder) {
  const testing::TemporaryFolder folder;
  folder.write("secret.mtl", "newmtl a\n");
  folder.write("heads/a.mtl", "map_Kd ../secret.mtl\nmap_Kd /etc/passwd\n");
  const MaterialFiles found =
      find_material_files(folder / "heads/head.obj", {"../secret.mtl", "a.mtl", "/etc/passwd"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl"}));
  EXPECT_EQ(found.warnings.size(), 4U);
}

TEST(MaterialFiles, MissingOnesAreWarnings) {
  const testing::TemporaryFolder folder;
  const MaterialFiles found = find_material_files(folder / "head.obj", {"none.mtl"});
  EXPECT_TRUE(found.files.empty());
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("none.mtl"));
}

}  // namespace
}  // namespace crowdface
