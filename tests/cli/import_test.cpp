// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_file.h"

#include "cli/program_test.h"
#include "support/model_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  EXPECT_TRUE(fs::exists(path)) << path;
  return read_text(path);
}

/// A config for what was imported, with the tags as they stand.
std::string config_of(const std::string& tags, const std::string& mask) {
  return concat("schema: 1\ncrowd: {name: mob, count: 1}\noutput: {directory: out}\n",
                tags.empty() ? "faces:\n" : tags, "  directory: heads\n  units: cm\n",
                "  align: none\nregions: {names: [top, middle, bottom], mask: heads/", mask, "}\n");
}

TEST(Import, MakeHumanHeadsAreReadyForACrowd) {
  const TemporaryFolder folder;
  write_makehuman(folder / "package");
  const auto import = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"import",  "makehuman",
                                          "--data",  (folder / "package").string(),
                                          "-o",      (folder / out).string(),
                                          "--count", "3",
                                          "--seed",  "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    crowdface(0, arguments, {"3 heads"});
  };
  import("heads", {});
  const fs::path config = folder.write(
      "crowd.yaml", config_of(read(folder / "heads/tags.yaml"), "makehuman_bands.png"));
  crowdface(0, {"check", config.string()}, {"is fine", "3: makehuman_01"});
  const std::string head = read(folder / "heads/makehuman_02.obj");
  EXPECT_THAT(head, ::testing::HasSubstr("\nusemtl eyeball_l\n"));
  import("again", {"--threads", "1"});
  EXPECT_EQ(head, read(folder / "again/makehuman_02.obj"));
  import("fine", {"--vertices", "1100"});
  const ObjFile fine = read_obj(folder / "fine/makehuman_01.obj");
  EXPECT_GT(fine.topology.vertex_count, 700);
  EXPECT_LT(fine.topology.vertex_count, 1700);
  EXPECT_THAT(polygon_materials(fine.materials, fine.topology.face_count()).names.back(),
              ::testing::Eq("eyeball_l"));
}

TEST(Import, TheMakeHumanBodyFitsItsHeads) {
  const TemporaryFolder folder;
  write_makehuman(folder / "package");
  write_makehuman_wardrobe(folder / "package");
  const auto import = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"import",  "makehuman",
                                          "--data",  (folder / "package").string(),
                                          "-o",      (folder / "heads").string(),
                                          "--count", "3",
                                          "--body",  "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    crowdface(0, arguments, {"body in "});
  };
  const fs::path config = folder.write(
      "crowd.yaml", concat("schema: 1\ncrowd: {name: mob, count: 1}\noutput: {directory: out}\n",
                           "faces: {directory: heads, units: cm, align: none}\n",
                           "neck: {body: heads/body/body.obj}\n"));
  import({});
  EXPECT_FALSE(fs::exists(folder / "heads/body/body.png"));
  crowdface(0, {"check", config.string()}, {"is fine"});
  import({"--vertices", "1100"});
  crowdface(0, {"check", config.string()}, {"is fine"});
  import({"--dress"});
  crowdface(0, {"check", config.string()}, {"is fine"});
  EXPECT_EQ(read_image(folder / "heads/body/body.png").channels, 3);
  EXPECT_THAT(read(folder / "heads/body/body.obj"), ::testing::HasSubstr("\nmtllib body.mtl\n"));
}

TEST(Import, MakeHumanHeadsAreDressed) {
  const TemporaryFolder folder;
  write_makehuman(folder / "package");
  write_makehuman_wardrobe(folder / "package");
  const auto import = [&](int code, const std::string& out, std::vector<std::string> more,
                          const std::vector<std::string>& says = {}) {
    std::vector<std::string> arguments = {"import",  "makehuman",
                                          "--data",  (folder / "package").string(),
                                          "-o",      (folder / out).string(),
                                          "--count", "4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    crowdface(code, arguments, says);
  };
  import(0, "heads", {"--dress"}, {"4 heads", "licences.txt"});
  EXPECT_THAT(read(folder / "heads/makehuman_01.obj"),
              ::testing::HasSubstr("\nmtllib makehuman_01.mtl\n"));
  EXPECT_THAT(read(folder / "heads/makehuman_01.mtl"),
              ::testing::HasSubstr("map_Kd makehuman_01_skin.png\n"));
  EXPECT_THAT(read(folder / "heads/licences.txt"),
              ::testing::HasSubstr("bob01: AGPL3 (see there); by Some One, http://here\n"));
  const Image skin = read_image(folder / "heads/makehuman_01_skin.png");
  EXPECT_EQ(skin.channels, 3);
  const std::string items = read(folder / "heads/attachments/attachments.yaml");
  EXPECT_THAT(items,
              ::testing::HasSubstr(
                  "{name: short02, kind: hair, file: short02.obj, tags: [male], tint: hair}\n"));
  // The average head and what was fitted to it make sense to the rest of the program.
  const fs::path config = folder / "crowd.yaml";
  crowdface(0, {"init", (folder / "heads").string(), "-o", config.string()}, {"attachments"});
  crowdface(0, {"check", config.string()}, {"is fine", "attachments eyebrow001"});
  // Ready for "24 dressed people, half of them women": nothing need be written by hand.
  const std::string ready = read(config);
  EXPECT_THAT(ready, ::testing::HasSubstr("attachments: {from: heads/attachments}\n"));
  EXPECT_THAT(ready, ::testing::HasSubstr("- {name: women, share: 0.5, tags: [female]}\n"));
  EXPECT_THAT(items, ::testing::HasSubstr("quotas: {beard: 0.25}"));
  EXPECT_THAT(items, ::testing::HasSubstr("name: moustache, kind: beard, "));
  const std::string tags = read(folder / "heads/tags.yaml");
  // What no head may wear is left out: of heads that are men alone the women's hair.
  folder.write("heads/tags.yaml",
               "faces: {tags: {makehuman_01: [male], makehuman_02: [male], makehuman_03: [male]}}");
  crowdface(0, {"init", (folder / "heads").string(), "-o", config.string(), "--force"});
  EXPECT_THAT(read(config), ::testing::Not(::testing::HasSubstr("groups:")));
  const Outcome men = crowdface(0, {"check", config.string()}, {"is fine"});
  EXPECT_THAT(men.out, ::testing::Not(::testing::HasSubstr("long01")));
  const std::string wearables = read(folder / "heads/attachments/attachments.yaml");
  folder.write("heads/attachments/attachments.yaml", "attachments: {items: [{name: a}]}");
  crowdface(64, {"init", (folder / "heads").string(), "-o", config.string(), "--force"},
            {"attachments.yaml:1:", "kind: missing"});
  folder.write("heads/attachments/attachments.yaml", wearables);
  folder.write("heads/tags.yaml", tags);
  // A second run finds all as it should be and writes what is missing; what was changed is not
  // lost.
  fs::remove(folder / "heads/attachments/base.obj");
  import(0, "heads", {"--dress"});
  EXPECT_TRUE(fs::exists(folder / "heads/attachments/base.obj"));
  folder.write("heads/makehuman_02_skin.png", "painted over");
  import(64, "heads", {"--dress"}, {"makehuman_02_skin.png: already exists"});
  import(0, "fine", {"--dress", "--vertices", "1100"});
  EXPECT_EQ(read_obj(folder / "fine/attachments/base.obj").topology.vertex_count,
            read_obj(folder / "fine/makehuman_03.obj").topology.vertex_count);
  import(64, "other", {"--textures", "512"}, {"--dress"});
  crowdface(0,
            {"import", "makehuman", "--data", (folder / "package").string(), "-o",
             (folder / "none").string(), "--count", "0", "--dress"},
            {"0 heads"});
  EXPECT_THAT(read(folder / "none/attachments/attachments.yaml"),
              ::testing::HasSubstr("items: []\n"));
}

TEST(Import, IctHeadsKeepTheirFileAndTiles) {
  const TemporaryFolder folder;
  write_ict(folder / "kit", 2);
  const std::string kit = (folder / "kit").string(), out = (folder / "heads").string();
  crowdface(0, {"import", "ict", "--data", kit, "-o", out, "--count", "2"},
            {"2 heads", "2 identity modes"});
  EXPECT_THAT(read(folder / "heads/ict_01.obj"), ::testing::HasSubstr("\ng face\nusemtl M_Face\n"));
  read(folder / "heads/ICTFaceModelMaterial.mtl");
  EXPECT_FALSE(fs::exists(folder / "heads/tags.yaml"));
  const fs::path config = folder.write("crowd.yaml", config_of("", "ict_bands.<UDIM>.png"));
  crowdface(0, {"check", config.string()}, {"is fine"});
  crowdface(64, {"import", "ict", "--data", kit, "-o", out, "--vertices", "9000"}, {"--vertices"});
  crowdface(64, {"import", "ict", "--data", kit, "-o", out, "--dress"}, {"--dress"});
  crowdface(64, {"import", "ict", "--data", kit, "-o", out, "--body"}, {"--body"});
  crowdface(0, {"import", "ict", "--data", kit, "-o", out, "--count", "3"});
  crowdface(64, {"import", "ict", "--data", kit, "-o", out, "--count", "2", "--seed", "2"},
            {"ict_01.obj: already exists", "ict_02.obj: already exists"});
}

TEST(Import, WhatIsNotThereIs66) {
  const TemporaryFolder folder;
  const std::string out = (folder / "heads").string();
  for (const std::string model : {"makehuman", "ict"}) {
    crowdface(66, {"import", model, "--data", folder.path().string(), "-o", out},
              {folder.path().string()});
  }
  crowdface(64, {"import", "basel", "--data", out, "-o", out});
}

}  // namespace
}  // namespace crowdface::testing
