// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/surface_materials.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

TEST(SurfaceMaterials, AreReadWithTheTexturesThatAreThere) {
  const testing::TemporaryFolder folder;
  folder.write("hair.mtl",
               "newmtl cards\nKd 0.5 0.25 1\nd 0.75\nmap_Kd maps/long hair.png\n"
               "map_d -imfchan m maps\\holes.png\nnewmtl lens\nTr 0.9\nmap_Kd missing.png\n");
  folder.write("maps/long hair.png", "1");
  folder.write("maps/hair.png", "2");
  folder.write("maps/holes.png", "3");
  const MaterialFiles files = find_material_files(folder / "hair.obj", {"hair.mtl"});
  const auto materials = read_surface_materials(files);
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[0].name, "cards");
  EXPECT_EQ(materials[0].colour, (std::array<float, 3>{0.5F, 0.25F, 1}));
  EXPECT_EQ(materials[0].opacity, 0.75F);
  EXPECT_EQ(materials[0].colour_map.filename(), "long hair.png");
  EXPECT_EQ(materials[0].opacity_map.filename(), "holes.png");
  EXPECT_FALSE(materials[1].colour);
  EXPECT_FLOAT_EQ(materials[1].opacity, 0.1F);
  EXPECT_TRUE(materials[1].colour_map.empty());
}

// Each end of the line was copied for each texture.
TEST(SurfaceMaterials, LinesOfManyWordsAreCheap) {
  const testing::TemporaryFolder folder;
  std::string line = "map_Kd";
  for (int i = 0; i < 500'000; ++i) line += " a";
  folder.write("a.mtl", "newmtl a\nKd -1 0.5 1e300\n" + line + " b.png\n");
  folder.write("b.png", "x");
  const auto materials = read_surface_materials(find_material_files(folder / "a.obj", {"a.mtl"}));
  ASSERT_EQ(materials.size(), 1U);
  EXPECT_EQ(materials[0].colour_map.filename(), "b.png");
  EXPECT_EQ(materials[0].colour, (std::array<float, 3>{0, 0.5F, 1}));
}

}  // namespace
}  // namespace crowdface
