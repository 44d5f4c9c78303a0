// SPDX-License-Identifier: Apache-2.0
// Textures that faces get of their own.
#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/io/image.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::read_text;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

void run(const SmallCrowdFolder& folder, std::vector<std::string> set = {},
         Replace replace = Replace::kRefuse) {
  ConfigOverrides overrides;
  overrides.set = std::move(set);
  generate(folder.config(), overrides, {folder.cache(), replace, false});
}

std::string grey_png(int side, int grey) {
  return encode_png(side, side, 1,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(side * side),
                                              static_cast<std::uint8_t>(grey)));
}

/// Four heads, each with a material file and a grey of its own, and a map that is no colour.
class OwnTextures : public ::testing::Test {
 protected:
  OwnTextures() : folder_(crowd()) {
    int grey = 60;
    for (const std::string& name : folder_.names()) {
      std::string text = read_text(folder_.head(name));
      const std::size_t at = text.find("bowl.mtl");
      folder_.folder().write(concat("heads/", name, ".obj"),
                             text.replace(at, 8, concat(name, ".mtl")));
      folder_.folder().write(
          concat("heads/", name, ".mtl"),
          concat("newmtl skin\nKd 1 1 1\nmap_Kd ", name, ".png\nmap_Bump bump.png\n"));
      folder_.folder().write(concat("heads/", name, ".png"), grey_png(32, grey));
      grey += 40;
    }
    folder_.folder().write("heads/bump.png", grey_png(4, 9));
  }

  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.bowl.materials = true;
    return crowd;
  }
  fs::path meshes() const { return folder_.out() / "meshes"; }

  SmallCrowdFolder folder_;
};

TEST_F(OwnTextures, LieBesideMeshesThatNameThem) {
  run(folder_);
  std::set<std::string> greys;
  for (const char* id : {"mob_0001", "mob_0002", "mob_0003", "mob_0004"}) {
    const Image image = read_image(meshes() / "blended" / concat(id, ".png"));
    EXPECT_EQ(image.width, 32);
    const float grey = image.at(16, 16, 0) * 255;
    EXPECT_GE(grey, 59.9F) << "between the heads'";
    EXPECT_LE(grey, 180.1F);
    greys.insert(format_fixed(static_cast<double>(grey), 3));
    const std::string library = read_text(meshes() / concat(id, ".mtl"));
    EXPECT_THAT(library, HasSubstr(concat("map_Kd blended/", id, ".png\n")));
    EXPECT_THAT(library, HasSubstr("map_Bump bump.png\n"));
    EXPECT_THAT(read_text(meshes() / concat(id, ".obj")),
                HasSubstr(concat("mtllib ", id, ".mtl\n")));
  }
  EXPECT_GT(greys.size(), 2U) << "each its own";
  EXPECT_TRUE(fs::exists(meshes() / "bump.png"));
  EXPECT_FALSE(fs::exists(meshes() / "ann.png"));
  EXPECT_FALSE(fs::exists(meshes() / "ann.mtl"));
  EXPECT_TRUE(verify_crowd(folder_.out()).good());
}

TEST_F(OwnTextures, AreMadeAgainIfTheyAreLostAndOnlyThen) {
  run(folder_, {"output.meshes=[obj, glb]"});
  const auto files = testing::crowd_files(folder_.out());
  const fs::path kept = meshes() / "blended/mob_0001.png", lost = meshes() / "blended/mob_0003.png";
  const auto written = fs::last_write_time(kept);
  fs::remove(lost);
  EXPECT_FALSE(verify_crowd(folder_.out()).good());
  run(folder_, {"output.meshes=[obj, glb]"});
  EXPECT_TRUE(fs::exists(lost));
  EXPECT_EQ(fs::last_write_time(kept), written);
  EXPECT_THAT(testing::differing_files(files, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
  folder_.folder().write("heads/bob.png", grey_png(32, 250));
  run(folder_, {"output.meshes=[obj, glb]"});
  EXPECT_NE(testing::crowd_files(folder_.out()), files) << "another texture, other faces";
}

TEST_F(OwnTextures, AreInsideGlbFiles) {
  run(folder_, {"output.meshes=[glb]", "textures.formats=[jpeg]"});
  EXPECT_FALSE(fs::exists(meshes() / "blended/mob_0001.jpg"));
  const std::string glb = read_text(meshes() / "mob_0001.glb");
  EXPECT_THAT(glb, HasSubstr("\"mimeType\":\"image/jpeg\""));
  EXPECT_THAT(glb, HasSubstr("\"baseColorTexture\":{\"index\":0}"));
  EXPECT_THAT(glb, HasSubstr("\xFF\xD8\xFF"));
}

TEST_F(OwnTextures, AreTheSameOnAnyNumberOfThreads) {
  {
    const ThreadLimit limit(1);
    run(folder_, {"output.contact_sheet={cell: 32}"});
  }
  const auto first = testing::crowd_files(folder_.out());
  fs::remove_all(folder_.out());
  const ThreadLimit limit(5);
  run(folder_, {"output.contact_sheet={cell: 32}"});
  EXPECT_THAT(testing::differing_files(first, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
}

TEST_F(OwnTextures, AreOfTheSizeAndFormatsAskedFor) {
  run(folder_, {"textures={size: 16, formats: [jpeg, png]}"});
  EXPECT_EQ(read_image(meshes() / "blended/mob_0002.png").width, 16);
  EXPECT_TRUE(fs::exists(meshes() / "blended/mob_0002.jpg"));
  EXPECT_THAT(read_text(meshes() / "mob_0002.mtl"), HasSubstr("map_Kd blended/mob_0002.jpg"));
}

TEST_F(OwnTextures, AreNotMadeWhereTheTargetsAreAskedFor) {
  run(folder_);
  run(folder_, {"textures.blend=target"}, Replace::kForce);
  EXPECT_FALSE(fs::exists(meshes() / "blended")) << "the old crowd's are removed";
  EXPECT_FALSE(fs::exists(meshes() / "mob_0001.mtl"));
  EXPECT_TRUE(fs::exists(meshes() / "ann.png") || fs::exists(meshes() / "bob.png") ||
              fs::exists(meshes() / "cyd.png") || fs::exists(meshes() / "dan.png"));
}

TEST_F(OwnTextures, AHeadWithoutOneIsToldAndADamagedOneEndsTheRun) {
  fs::remove(folder_ / "heads/cyd.png");
  run(folder_);
  EXPECT_THAT(testing::read_json(folder_.out() / "report.json").at("warnings").dump(),
              HasSubstr("cyd: has no colour texture"));
  EXPECT_TRUE(fs::exists(meshes() / "blended/mob_0004.png"));
  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < 1024; ++i)
    pixels.push_back(static_cast<std::uint8_t>(i * i * 37 % 251));
  std::string damaged = encode_png(32, 32, 1, pixels);
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] + 1);
  folder_.folder().write("heads/cyd.png", damaged);
  testing::expect_error(ExitCode::kBadData, {"cyd.png"}, [&] { run(folder_); });
}

}  // namespace
}  // namespace crowdface
