// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/material_files.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/tile_files.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> names(const MaterialFiles& files) {
  std::vector<std::string> result;
  for (const MaterialFile& file : files.files) result.push_back(file.destination.string());
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

TEST(MaterialFiles, HaveNoTilesWithoutTheWord) {
  const testing::TemporaryFolder folder;
  folder.write("skin.1001.png", "x");
  EXPECT_TRUE(find_tiles(folder / "skin.1001.png").empty());
  EXPECT_EQ(find_tiles(folder / "skin.<UDIM>.png").size(), 1U);
}

TEST(Textures, OfOtherMachinesAreFoundInSubfoldersWhateverTheirCase) {
  const testing::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nmap_Kd C:\\proj\\Textures\\skin.png\nnorm maps/N.PNG\n");
  folder.write("textures/Skin.PNG", "x");
  folder.write("tex/n.png", "x");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl", "textures/Skin.PNG", "tex/n.png"}));
  EXPECT_TRUE(found.warnings.empty());
}

// Archives made on macOS hold decomposed names, whatever the material file has.
TEST(Textures, AreFoundByComposedAndDecomposedNames) {
  const testing::TemporaryFolder folder;
  folder.write("a.mtl",
               "newmtl a\nmap_Kd Kopf_\u00e9.png\nnorm Fu\u0308\u00df/ha\u0323\u0302u.png\n"
               "map_Pr \ud55c\uae00.png\nnewmtl b\nmap_Kd \u30ac.png\n");
  const std::vector<std::string> there = {"Kopf_e\u0301.png", "F\u00fc\u00df/h\u1eadu.png",
                                          "\u1112\u1161\u11ab\u1100\u1173\u11af.png",
                                          "\u30ab\u3099.png"};
  for (const std::string& name : there) folder.write(name, "x");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found),
            (std::vector<std::string>{"a.mtl", there[0], there[1], there[2], there[3]}));
  EXPECT_TRUE(found.warnings.empty());
}

TEST(Textures, OfOtherMachinesMayHaveTiles) {
  const testing::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nmap_Kd C:\\proj\\Skin.<UDIM>.png\n");
  for (const char* name : {"tex/skin.1001.png", "tex/skin.1002.png"}) folder.write(name, "x");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found),
            (std::vector<std::string>{"a.mtl", "tex/skin.1001.png", "tex/skin.1002.png"}));
  EXPECT_TRUE(found.warnings.empty());
}

// Each statement listed the folder, however often it stood there and whatever it named.
TEST(MaterialFiles, LookForEachNameOnce) {
  const testing::TemporaryFolder folder;
  for (int i = 0; i < 300; ++i) folder.write("file" + std::to_string(i), "");
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "map_Kd skin.<UDIM>.png\nmap_Ks none.png\n";
  folder.write("a.mtl", text);
  folder.write("skin.1001.png", "x");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl", "a.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl", "skin.1001.png"}));
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("none.png"));
}

TEST(MaterialFiles, NamesOfTexturesMayHoldBlanks) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"head diffuse.png", "rough.png", "skin tone.1001.png"}) {
    folder.write(name, "x");
  }
  folder.write("a.mtl",
               "newmtl a\nmap_Kd head diffuse.png \r\nmap_Ks -s 1 1 1 head diffuse.png\n"
               "map_Ns -o 0 0 rough.png\nnewmtl b\nmap_Kd skin tone.<UDIM>.png\n"
               "map_bump -bm 0.5 lost.png\nmap_d not there.png\n");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl", "head diffuse.png", "rough.png",
                                                    "skin tone.1001.png"}));
  ASSERT_EQ(found.warnings.size(), 2U);
  EXPECT_THAT(found.warnings[0], HasSubstr("\"lost.png\" is missing"));
  EXPECT_THAT(found.warnings[1], HasSubstr("\"not there.png\" is missing"));
  const auto colours =
      find_textures(folder / "head.obj", {"a.mtl"}).paths_by_kind.at(TextureKind::kColour);
  EXPECT_EQ(colours.at("a"), folder / "head diffuse.png");
}

// All ends of a line were kept at once: 40 KB took half a gigabyte.
TEST(MaterialFiles, LinesOfManyWordsAreCheap) {
  const testing::TemporaryFolder folder;
  std::string line = "map_Kd";
  for (int i = 0; i < 500'000; ++i) line += " a";
  folder.write("a.mtl", "newmtl a\n" + line + " b.png\nmap_Ks   \nmap_Ns\n");
  folder.write("b.png", "x");
  EXPECT_EQ(names(find_material_files(folder / "head.obj", {"a.mtl"})),
            (std::vector<std::string>{"a.mtl", "b.png"}));
}

TEST(MaterialFiles, TakeSoManyTexturesAndNoMore) {
  const testing::TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 1200; ++i) {
    text += concat("newmtl m", i, "\nmap_Kd t", i, ".png\n");
  }
  folder.write("a.mtl", text + "newmtl again\nmap_Kd t7.png\n");
  folder.write("t999.png", "x");
  folder.write("t1000.png", "x");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl", "t999.png"}));
  ASSERT_EQ(found.warnings.size(), 1000U) << "999 are missing, and one warning for the others";
  for (const std::string part : {"a.mtl", "1000 textures", "t1000.png", "--limit textures"}) {
    EXPECT_THAT(found.warnings.back(), HasSubstr(part));
  }
  const auto colours =
      find_textures(folder / "head.obj", {"a.mtl"}).paths_by_kind.at(TextureKind::kColour);
  EXPECT_EQ(colours.size(), 1001U);
  EXPECT_TRUE(colours.contains("again"));
}

TEST(MaterialFiles, TakeSoManyLibrariesAndNoMore) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> line(3, "a.mtl b.mtl");
  EXPECT_EQ(find_material_files(folder / "head.obj", line).warnings.size(), 2U) << "each once";
  std::string all;
  for (int i = 0; i < 1200; ++i) all += "m" + std::to_string(i) + ".mtl ";
  const MaterialFiles found = find_material_files(folder / "head.obj", {all});
  EXPECT_EQ(found.warnings.size(), 1001U);
  EXPECT_THAT(found.warnings.back(), HasSubstr("head.obj: names more than 1000 material files"));
}

TEST(MaterialFiles, NeverTakeTheNameOfAMesh) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> refused = {
      "mob_0001.obj", "mob_0001.PLY", "mob_0001.glb",         "mob_0001.npy",       "tex/a.obj",
      "b.ply/c.png",  "topology",     "topology/corners.png", "x/../topology/d.png"};
  std::string text;
  for (const std::string& name : refused) {
    if (name != "topology") folder.write(name, "x");
    text += "map_Kd " + name + "\n";
  }
  folder.write("x/topology/skin.obj.png", "x");
  folder.write("a.mtl", text + "map_Kd x/topology/skin.obj.png\n");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl", "mob_0001.obj"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl", "x/topology/skin.obj.png"}));
  ASSERT_EQ(found.warnings.size(), refused.size() + 1);
  for (const std::string& warning : found.warnings) {
    EXPECT_THAT(warning, HasSubstr("belongs to crowdface's own files and is not copied"));
  }
}

// Ledger and report are UTF-8: a line for such a file named no file.
TEST(MaterialFiles, NeverTakeANameThatIsNotUtf8) {
  const testing::TemporaryFolder folder;
  folder.write("h\xe4ut.png", "x");
  folder.write("häut.png", "x");
  folder.write("a.mtl", "map_Kd h\xe4ut.png\nmap_Ks häut.png\n");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl", "häut.png"}));
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("\"h\\xe4ut.png\" has a name that is not UTF-8"));
}

// The system reads a name up to its NUL: the mesh of that name was written over.
TEST(MaterialFiles, NeverTakeANameWithANul) {
  const testing::TemporaryFolder folder;
  folder.write("mob_0001.obj", "x");
  folder.write("a.mtl", std::string("map_Kd mob_0001.obj") + '\0' + ".png\n");
  const MaterialFiles found = find_material_files(folder / "head.obj", {"a.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"a.mtl"}));
  EXPECT_EQ(found.warnings.size(), 1U);
  EXPECT_TRUE(find_textures(folder / "head.obj", {"a.mtl"}).paths_by_kind.empty());
}

TEST(Textures, AreNamedByKindAndMaterial) {
  const testing::TemporaryFolder folder;
  folder.write("sub/a.mtl",
               "newmtl the skin \nmap_Ks gloss.png\nmap_Kd -s 1 1 1 skin.<UDIM>.png\n"
               "newmtl eye\nKd 1 1 1\nnewmtl out\nmap_Kd ../../out.png\n");
  const auto found =
      find_textures(folder / "head.obj", {"sub/a.mtl"}).paths_by_kind.at(TextureKind::kColour);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.begin()->first, "the skin");
  EXPECT_EQ(udim_tile_path(found.begin()->second, 1003), folder / "sub/skin.1003.png");
  const auto specular =
      find_textures(folder / "head.obj", {"sub/a.mtl"}).paths_by_kind.at(TextureKind::kSpecular);
  EXPECT_EQ(specular.at("the skin"), folder / "sub/gloss.png");
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

TEST(MaterialFiles, ImagesOutsideTheFolderAreTakenUnderTheirNames) {
  const testing::TemporaryFolder folder;
  const std::vector<std::uint8_t> pixels(3, 7);
  folder.write("textures/skin.png", encode_png(1, 1, 3, pixels));
  folder.write("textures/eye.1001.png", encode_png(1, 1, 3, pixels));
  folder.write("textures/notes.png", "no image");
  folder.write("heads/a.mtl", concat("newmtl a\nmap_Kd ../textures/skin.png\nnewmtl b\nmap_Kd ",
                                     (folder / "textures/eye.<UDIM>.png").string(),
                                     "\nnorm ../textures/notes.png\nbump link.png\n"));
  std::filesystem::create_symlink(folder / "textures/skin.png", folder / "heads/link.png");
  const auto mesh = folder / "heads/head.obj";
  const MaterialFiles found = find_material_files(mesh, {"a.mtl"});
  EXPECT_EQ(names(found),
            (std::vector<std::string>{"a.mtl", "skin.png", "eye.1001.png", "link.png"}));
  EXPECT_EQ(found.files[1].source, folder / "textures/skin.png");
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("\"../textures/notes.png\" lies outside"));
  const auto colours = find_textures(mesh, {"a.mtl"}).paths_by_kind.at(TextureKind::kColour);
  EXPECT_EQ(colours.at("a"), folder / "textures/skin.png");
  EXPECT_EQ(udim_tile_path(colours.at("b"), 1001), folder / "textures/eye.1001.png");
}

TEST(MaterialFiles, AreReadAsProgramsWriteThem) {
  const std::string plain = "newmtl skin\nmap_Kd skin.png\nnewmtl eye\nmap_Kd eye.png\n";
  std::string with_cr = plain;
  std::ranges::replace(with_cr, '\n', '\r');
  for (const std::string& text :
       {"\xef\xbb\xbf" + plain, with_cr,
        std::string("NEWMTL skin\nmap_kd skin.png\nnewmtl eye\nMAP_KD eye.png\n"),
        std::string("newmtl skin\nmap_Kd \"skin.png\"\nnewmtl eye\nmap_Kd eye.png # brown\n"),
        std::string("newmtl skin\nmap_Kd s%6Bin.png\nnewmtl eye\nmap_Kd eye.png\n")}) {
    const testing::TemporaryFolder folder;
    folder.write("mats/a.mtl", text);
    folder.write("mats/skin.png", "x");
    folder.write("eye.png", "x");
    for (const char* library : {"mats/a.mtl", "\"mats/A.MTL\""}) {
      const auto of_kind = find_textures(folder / "head.obj", {library}).paths_by_kind;
      ASSERT_TRUE(of_kind.contains(TextureKind::kColour)) << text;
      EXPECT_EQ(of_kind.at(TextureKind::kColour).at("skin"), folder / "mats/skin.png") << text;
      EXPECT_EQ(of_kind.at(TextureKind::kColour).at("eye"), folder / "eye.png") << text;
    }
  }
  const testing::TemporaryFolder folder;
  folder.write("a.mtl", std::string("\xff\xfen\0e\0w\0m\0t\0l\0 \0a\0\n\0", 20));
  EXPECT_EQ(find_textures(folder / "head.obj", {"a.mtl"}).single_material, "a") << "UTF-16";
  folder.write("b.mtl", std::string("n\0e\0w\0", 6));
  const MaterialFiles found = find_material_files(folder / "head.obj", {"b.mtl"});
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("save it as UTF-8"));
}

TEST(MaterialFiles, LibrariesOfOtherMachinesAreFoundBesideTheMesh) {
  const testing::TemporaryFolder folder;
  folder.write("my head.mtl", "newmtl a\n");
  folder.write("tex/b.mtl", "newmtl b\n");
  for (const char* path : {"C:\\Users\\Ann Lee\\my head.mtl", "/scans/my head.mtl"}) {
    const MaterialFiles found = find_material_files(folder / "head.obj", {path});
    EXPECT_EQ(names(found), (std::vector<std::string>{"my head.mtl"})) << path;
    EXPECT_THAT(found.warnings, ::testing::IsEmpty()) << path;
    EXPECT_TRUE(found.has_library_at_other_path) << path;
  }
  EXPECT_EQ(names(find_material_files(folder / "head.obj", {"tex\\b.mtl"})),
            (std::vector<std::string>{"tex/b.mtl"}));
  EXPECT_FALSE(find_material_files(folder / "head.obj", {"tex/b.mtl"}).has_library_at_other_path);
}

// The table SHIFT_JIS reads a backslash as ¥, so that the path had no folders.
TEST(MaterialFiles, OfAJapaneseMachineAreFoundBesideTheMesh) {
  const testing::TemporaryFolder folder;
  folder.write("素材.mtl", "newmtl a\nmap_Kd C:\\\x91\xbe\x98Y\\\x8a\xe7.png\n");
  folder.write("顔.png", "x");
  const MaterialFiles found =
      find_material_files(folder / "head.obj", {"C:\\\x91\xbe\x98Y\\\x91\x66\x8d\xde.mtl"});
  EXPECT_EQ(names(found), (std::vector<std::string>{"素材.mtl", "顔.png"}));
  EXPECT_TRUE(found.warnings.empty());
}

TEST(MaterialFiles, MissingOnesAreWarnings) {
  const testing::TemporaryFolder folder;
  const MaterialFiles found = find_material_files(folder / "head.obj", {"none.mtl"});
  EXPECT_TRUE(found.files.empty());
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_THAT(found.warnings[0], HasSubstr("none.mtl"));
}

TEST(SurfaceMaterials, AreReadWithTheTexturesThatAreThere) {
  const testing::TemporaryFolder folder;
  folder.write("hair.mtl",
               "newmtl cards\nKd 0.5 0.25 1\nd 0.75\nmap_Kd maps/long hair.png\n"
               "map_d -imfchan m maps\\holes.png\nnewmtl lens\nTr 0.9\nmap_Kd missing.png\n");
  folder.write("maps/long hair.png", "1");
  folder.write("maps/hair.png", "2");
  folder.write("maps/holes.png", "3");
  const MaterialFiles files = find_material_files(folder / "hair.obj", {"hair.mtl"});
  const auto materials = files.surface_materials;
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
  const auto materials = find_material_files(folder / "a.obj", {"a.mtl"}).surface_materials;
  ASSERT_EQ(materials.size(), 1U);
  EXPECT_EQ(materials[0].colour_map.filename(), "b.png");
  EXPECT_EQ(materials[0].colour, (std::array<float, 3>{0, 0.5F, 1}));
}

// Attachments with such a path had no colours in GLB and USD files, although the file was copied.
TEST(SurfaceMaterials, PathsOfAnotherMachineAreFound) {
  const testing::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nmap_Kd C:\\work\\strands.png\n");
  folder.write("strands.png", "x");
  const MaterialFiles files = find_material_files(folder / "a.obj", {"a.mtl"});
  ASSERT_EQ(files.surface_materials.size(), 1U);
  EXPECT_EQ(files.surface_materials[0].colour_map, folder / "strands.png");
}

}  // namespace
}  // namespace crowdface
