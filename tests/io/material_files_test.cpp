// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/material_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/io/tile_files.h"

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

TEST(MaterialFiles, TakeAllTilesOfATexture) {
  const testing::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nmap_Kd tex/skin.<UDIM>.png\n");
  for (const char* name : {"1001", "1012", "10x1", "old.1001"}) {
    folder.write(std::string("tex/skin.") + name + ".png", "x");
  }
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found),
            (std::vector<std::string>{"a.mtl", "tex/skin.1001.png", "tex/skin.1012.png"}));
  EXPECT_TRUE(found.warnings.empty());
}

TEST(ColourTextures, AreThoseOfMapKd) {
  const testing::TemporaryFolder folder;
  folder.write("sub/a.mtl",
               "newmtl the skin \nmap_Ks gloss.png\nmap_Kd -s 1 1 1 skin.<UDIM>.png\n"
               "newmtl eye\nKd 1 1 1\nnewmtl out\nmap_Kd ../../out.png\n");
  const ColourTextures found = find_colour_textures(folder / "head.obj", {"sub/a.mtl"});
  ASSERT_EQ(found.of_material.size(), 1U);
  EXPECT_EQ(found.of_material.begin()->first, "the skin");
  EXPECT_EQ(with_tile(found.of_material.begin()->second, 1003), folder / "sub/skin.1003.png");
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
