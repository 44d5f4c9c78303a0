// SPDX-License-Identifier: Apache-2.0
// Textures that faces get of their own.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "crowdface/core/input_limits.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/io/image.h"
#include "crowdface/run/crowd_sheets.h"
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

std::string grey_png(int side, int grey) {
  return encode_png(side, side, 1,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(side * side),
                                              static_cast<std::uint8_t>(grey)));
}

/// Four heads, each with a material file and a grey of its own, and a map that is no colour.
class FaceTextureEncoder : public ::testing::Test {
 protected:
  FaceTextureEncoder() : folder_(crowd()) {
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

TEST_F(FaceTextureEncoder, LieBesideMeshesThatNameThem) {
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
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

/// A text without its `usemtl` lines.
std::string without_usemtl(const std::string& text) {
  std::string kept;
  for (const std::string_view line : split_lines(text)) {
    if (!line.starts_with("usemtl")) kept += concat(line, '\n');
  }
  return kept;
}

// The material file still named the target's texture, and no face used it.
TEST_F(FaceTextureEncoder, OfTheOnlyMaterialBelongToFacesWithoutOne) {
  for (const std::string& name : folder_.names()) {
    folder_.folder().write(concat("heads/", name, ".obj"),
                           without_usemtl(read_text(folder_.head(name))));
  }
  run(folder_);
  EXPECT_THAT(read_text(meshes() / "mob_0001.mtl"), HasSubstr("map_Kd blended/mob_0001.png\n"));
  EXPECT_THAT(read_text(meshes() / "mob_0001.obj"),
              HasSubstr("mtllib mob_0001.mtl\nusemtl skin\n"));
}

// A variant had the skin of the people whose detail it got.
TEST_F(FaceTextureEncoder, OfAVariantAreThoseOfItsFace) {
  std::string config = read_text(folder_.config());
  config.replace(config.find("align: none"), 11, "align: none, tags: {bob: [old], cyd: [old]}");
  folder_.folder().write("config.yaml", config);
  const auto picture = [&](const std::string& id) {
    return read_text(meshes() / "blended" / (id + ".png"));
  };
  run(folder_, {"changes={mob_0002: {variant_of: mob_0001, distance: 3 mm}}"});
  EXPECT_EQ(picture("mob_0002"), picture("mob_0001"));
  EXPECT_NE(picture("mob_0003"), picture("mob_0001"));
  EXPECT_NE(read_text(meshes() / "mob_0002.obj"), read_text(meshes() / "mob_0001.obj"));
  ConfigOverrides variants{
      {"changes={mob_0002: {variant_of: mob_0001, distance: 3 mm}}"}, {}, {}, {}};
  const auto review = [&](const char* changes) {
    const std::string file = concat("review_", variants.review.size(), ".yaml");
    variants.review = {
        folder_.folder().write(file, concat("schema: 1\nchanges: ", changes, "\n")).string()};
    run(folder_, variants);
  };
  review("{mob_0001: {age: 0.5}, mob_0003: {variant_of: mob_0004}, mob_0004: {age: older}}");
  EXPECT_EQ(picture("mob_0002"), picture("mob_0001")) << "both are older";
  EXPECT_NE(picture("mob_0003"), picture("mob_0004")) << "of the younger face";
  review("{mob_0003: {age: older}}");
  EXPECT_EQ(picture("mob_0003"), picture("mob_0004"));
}

TEST_F(FaceTextureEncoder, AreMadeAgainIfTheyAreLostAndOnlyThen) {
  run(folder_, {"output.meshes=[obj, glb]"});
  const auto files = testing::crowd_files(folder_.out());
  const fs::path kept = meshes() / "blended/mob_0001.png", lost = meshes() / "blended/mob_0003.png";
  const auto written = fs::last_write_time(kept);
  fs::remove(lost);
  EXPECT_FALSE(verify_crowd(folder_.out()).is_intact());
  run(folder_, {"output.meshes=[obj, glb]"});
  EXPECT_TRUE(fs::exists(lost));
  EXPECT_EQ(fs::last_write_time(kept), written);
  EXPECT_THAT(testing::differing_files(files, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
  folder_.folder().write("heads/bob.png", grey_png(32, 250));
  run(folder_, {"output.meshes=[obj, glb]"});
  EXPECT_NE(testing::crowd_files(folder_.out()), files) << "another texture, other faces";
}

TEST_F(FaceTextureEncoder, AreInsideGlbFiles) {
  run(folder_, {"output.meshes=[glb]", "textures.formats=[jpeg]"});
  EXPECT_FALSE(fs::exists(meshes() / "blended/mob_0001.jpg"));
  const std::string glb = read_text(meshes() / "mob_0001.glb");
  EXPECT_THAT(glb, HasSubstr("\"images\":[{\"name\":\"mob_0001\","));
  EXPECT_THAT(glb, HasSubstr("\"mimeType\":\"image/jpeg\""));
  EXPECT_THAT(glb, HasSubstr("\"baseColorTexture\":{\"index\":0}"));
  EXPECT_THAT(glb, HasSubstr("\xFF\xD8\xFF"));
}

TEST_F(FaceTextureEncoder, AreTheSameOnAnyNumberOfThreads) {
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

TEST_F(FaceTextureEncoder, AreTheSameWhereTheHeadsMapsLieOnTheDisk) {
  run(folder_, {"output.contact_sheet={cell: 32}"});
  const auto first = testing::crowd_files(folder_.out());
  fs::remove_all(folder_.out());
  const std::uint64_t before = input_limits().image_bytes;
  set_input_limit("image_bytes=40000");  // the four maps take 24,576
  run(folder_, {"output.contact_sheet={cell: 32}"});
  set_input_limit(concat("image_bytes=", before));
  EXPECT_THAT(testing::differing_files(first, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
}

TEST_F(FaceTextureEncoder, AreTheSameWithStatisticsFromTheCache) {
  const auto statistics = [&] {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder_.cache())) {
      if (entry.path().filename().string().starts_with("texture-statistics-")) {
        entries.push_back(entry.path());
      }
    }
    return entries;
  };
  run(folder_);
  const auto first = testing::crowd_files(folder_.out());
  ASSERT_EQ(statistics().size(), 1U) << "small heads keep them as well";
  const auto written = fs::last_write_time(statistics().front());
  fs::remove_all(folder_.out());
  run(folder_);
  EXPECT_EQ(fs::last_write_time(statistics().front()), written);
  EXPECT_THAT(testing::differing_files(first, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
}

TEST_F(FaceTextureEncoder, AreOfTheSizeAndFormatsAskedFor) {
  run(folder_, {"textures={size: 16, formats: [jpeg, png]}"});
  EXPECT_EQ(read_image(meshes() / "blended/mob_0002.png").width, 16);
  EXPECT_TRUE(fs::exists(meshes() / "blended/mob_0002.jpg"));
  EXPECT_THAT(read_text(meshes() / "mob_0002.mtl"), HasSubstr("map_Kd blended/mob_0002.jpg"));
}

TEST_F(FaceTextureEncoder, AreNotMadeWhereTheTargetsAreAskedFor) {
  run(folder_);
  run(folder_, {"textures.blend=target"}, Replace::kForce);
  EXPECT_FALSE(fs::exists(meshes() / "blended")) << "the old crowd's are removed";
  EXPECT_FALSE(fs::exists(meshes() / "mob_0001.mtl"));
  EXPECT_TRUE(fs::exists(meshes() / "ann.png") || fs::exists(meshes() / "bob.png") ||
              fs::exists(meshes() / "cyd.png") || fs::exists(meshes() / "dan.png"));
}

// EXR files were left behind, because only two of three endings were known.
TEST_F(FaceTextureEncoder, OfAnOldCrowdAreRemovedInEachFormat) {
  run(folder_, {"textures.formats=[png, jpeg, exr]"});
  EXPECT_TRUE(fs::exists(meshes() / "blended/mob_0001.exr"));
  run(folder_, {"textures.blend=target"}, Replace::kForce);
  EXPECT_FALSE(fs::exists(meshes() / "blended"));
}

// Faces kept their textures while heads turned plain: the ledger did not know the key.
TEST_F(FaceTextureEncoder, SheetsWithoutThemShowPlainFaces) {
  const std::string sheet = "output.contact_sheet={columns: 2, cell: 48";
  const auto render = [&](const char* out) {
    return read_text(folder_ / concat(out, "/renders/mob_0001.png"));
  };
  run_to(folder_, "plain", {{sheet + ", texture: false}"}, {}, {}, {}});
  run_to(folder_, "textured", {{sheet + "}"}, {}, {}, {}});
  EXPECT_FALSE(render("textured") == render("plain"));
  remake_sheets(folder_ / "textured", {"output.contact_sheet.texture=false"}, folder_.cache());
  EXPECT_TRUE(render("textured") == render("plain"));
}

// What only arranges pages makes no picture anew.
TEST_F(FaceTextureEncoder, SheetsOfOtherPagesKeepThePicturesOfFaces) {
  run(folder_, {"output.contact_sheet={columns: 2, cell: 48}"});
  const fs::path render = folder_.out() / "renders/mob_0001.png";
  const auto written = fs::last_write_time(render);
  remake_sheets(folder_.out(),
                {"output.contact_sheet.columns=1", "output.contact_sheet.labels=[id, target]"},
                folder_.cache());
  EXPECT_EQ(fs::last_write_time(render), written);
}

// Sheets showed textures that no mesh has.
TEST_F(FaceTextureEncoder, SheetsOfOtherTexturesAreRefused) {
  const std::string sheet = "output.contact_sheet={columns: 2, cell: 48}";
  run(folder_, {sheet});
  remake_sheets(folder_.out(), {}, folder_.cache());
  remake_sheets(folder_.out(), {"output.contact_sheet.texture=false"}, folder_.cache());
  fs::copy_file(folder_ / "heads/dan.png", folder_ / "heads/cyd.png",
                fs::copy_options::overwrite_existing);
  testing::expect_error(ExitCode::kUsage, {folder_.out().string(), "made with other textures"},
                        [&] { remake_sheets(folder_.out(), {}, folder_.cache()); });
  run(folder_, {sheet});
  remake_sheets(folder_.out(), {}, folder_.cache());
}

/// Of all faces' own pictures the bytes, by name.
std::map<std::string, std::string> pictures_in(const fs::path& folder) {
  std::map<std::string, std::string> pictures;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") {
      pictures[entry.path().filename().string()] = read_text(entry.path());
    }
  }
  return pictures;
}

TEST_F(FaceTextureEncoder, AHeadWhoseTextureIsMissingOrDamagedIsToldAndGoesWithout) {
  const auto warnings = [&] {
    return testing::read_json(folder_.out() / "report.json").at("warnings").dump();
  };
  fs::remove(folder_ / "heads/cyd.png");
  run(folder_);
  EXPECT_THAT(warnings(), HasSubstr("cyd: has no colour texture"));
  const auto without = pictures_in(meshes() / "blended");
  EXPECT_TRUE(without.contains("mob_0004.png"));

  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < 1024; ++i)
    pixels.push_back(static_cast<std::uint8_t>(i * i * 37 % 251));
  const std::string whole = encode_png(32, 32, 1, pixels);
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] + 1);
  for (const std::string& bytes : {damaged, whole.substr(0, whole.size() - 1), whole.substr(0, 20),
                                   std::string("II*\0\x08", 5)}) {
    folder_.folder().write("heads/cyd.png", bytes);
    fs::remove_all(folder_.out());
    run(folder_);
    EXPECT_THAT(warnings(), HasSubstr("cyd.png: "));
    EXPECT_EQ(pictures_in(meshes() / "blended"), without);
  }
  testing::expect_error(ExitCode::kBadData, {"cyd.png"}, [&] {
    run(folder_, {"output.contact_sheet={columns: 2, cell: 48, texture: true}"}, Replace::kForce);
  });
}

/// Normals that all lean to the right by a head's own angle.
std::string normal_png(int side, double lean) {
  const Eigen::Vector3d normal = Eigen::Vector3d(lean, 0, 1).normalized();
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < side * side; ++i) {
    for (Index c = 0; c < 3; ++c) {
      pixels.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (normal[c] + 1))));
    }
  }
  return encode_png(side, side, 3, pixels);
}

/// The four heads with maps of all kinds: normals in bytes, roughness in 16 bits, heights in
/// floats.
class OwnMaps : public FaceTextureEncoder {
 protected:
  OwnMaps() {
    double lean = 0;
    for (const std::string& name : folder_.names()) {
      write_library(name, "norm");
      folder_.folder().write(concat("heads/", name, "_n.png"), normal_png(16, lean));
      const auto words =
          std::vector<std::uint16_t>(64, static_cast<std::uint16_t>(8000 + 20000 * lean));
      folder_.folder().write(concat("heads/", name, "_r.png"), encode_png16(8, 8, 1, words));
      const std::vector<float> heights(64, static_cast<float>(-3 + 10 * lean));
      folder_.folder().write(concat("heads/", name, "_d.exr"), encode_exr(8, 8, 1, heights));
      lean += 0.2;
    }
  }
  void write_library(const std::string& name, const std::string& normals) {
    folder_.folder().write(concat("heads/", name, ".mtl"),
                           concat("newmtl skin\nKd 1 1 1\nmap_Kd ", name, ".png\n", normals, ' ',
                                  name, "_n.png\nmap_Pr ", name, "_r.png\ndisp -mm 0 0.5 ", name,
                                  "_d.exr\nmap_Ns bump.png\n"));
  }
};

TEST_F(OwnMaps, OfAllKindsAreBlendedAndNamed) {
  run(folder_, {"output.meshes=[obj, glb, usd]"});
  for (const std::string id : {"mob_0001", "mob_0002", "mob_0003", "mob_0004"}) {
    const std::string library = read_text(meshes() / concat(id, ".mtl"));
    for (const std::string line :
         {"map_Kd blended/ID.png\n", "norm blended/ID.normal.png\n",
          "map_Pr blended/ID.roughness.png\n", "disp -mm 0 0.5 blended/ID.displacement.exr\n",
          "map_Ns bump.png\n"}) {
      std::string wanted = line;
      if (const auto at = wanted.find("ID"); at != wanted.npos) wanted.replace(at, 2, id);
      EXPECT_THAT(library, HasSubstr(wanted));
    }
    const Image normals = read_image(meshes() / "blended" / concat(id, ".normal.png"));
    EXPECT_EQ(normals.pixels.index(), 1U) << "bytes, as the heads' are";
    const Eigen::Vector3d normal(2 * normals.at(8, 8, 0) - 1, 2 * normals.at(8, 8, 1) - 1,
                                 2 * normals.at(8, 8, 2) - 1);
    EXPECT_NEAR(normal.norm(), 1, 0.01);
    const double lean = normal.x() / normal.z();
    EXPECT_GT(lean, -0.01);
    EXPECT_LT(lean, 0.61);
    const Image roughness = read_image(meshes() / "blended" / concat(id, ".roughness.png"));
    EXPECT_EQ(roughness.pixels.index(), 2U) << "16 bits, as the heads' are";
    // All heads' numbers are the same function of the lean, and weights are, too.
    EXPECT_NEAR(65535 * roughness.at(4, 4, 0), 8000 + 20000 * lean, 300);
    const Image heights = read_image(meshes() / "blended" / concat(id, ".displacement.exr"));
    const double lean_of_roughness = (65535 * roughness.at(4, 4, 0) - 8000) / 20000;
    EXPECT_NEAR(heights.at(4, 4, 0), -3 + 10 * lean_of_roughness, 0.002);
    const std::string glb = read_text(meshes() / concat(id, ".glb"));
    EXPECT_THAT(glb, HasSubstr("\"normalTexture\":{\"index\":1}"));
    EXPECT_THAT(glb, HasSubstr("\"metallicRoughnessTexture\":{\"index\":2}"));
    const std::string usd = read_text(meshes() / concat(id, ".usda"));
    EXPECT_THAT(usd, HasSubstr(concat("@./blended/", id, ".normal.png@")));
    EXPECT_THAT(usd, HasSubstr("float inputs:roughness.connect"));
  }
  EXPECT_FALSE(fs::exists(meshes() / "ann_n.png"));
  EXPECT_TRUE(fs::exists(meshes() / "bump.png"));
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

TEST_F(OwnMaps, AreNeverBlurredByJpegAndCanAllBeExr) {
  run(folder_, {"textures.formats=[jpeg]"});
  EXPECT_TRUE(fs::exists(meshes() / "blended/mob_0001.jpg"));
  EXPECT_TRUE(fs::exists(meshes() / "blended/mob_0001.normal.png"));
  run(folder_, {"textures.formats=[exr]"}, Replace::kForce);
  const Image colour = read_image(meshes() / "blended/mob_0001.exr");
  EXPECT_TRUE(colour.has_floats());
  const Image normals = read_image(meshes() / "blended/mob_0001.normal.exr");
  EXPECT_GT(normals.at(4, 4, 2), 0.9F);
  EXPECT_THAT(read_text(meshes() / "mob_0001.mtl"), HasSubstr("norm blended/mob_0001.normal.exr"));
  testing::expect_error(ExitCode::kUsage, {"textures.formats", "glb"}, [&] {
    run(folder_, {"textures.formats=[exr]", "output.meshes=[glb]"}, Replace::kForce);
  });
}

TEST_F(OwnMaps, AreTheSameOnAnyNumberOfThreads) {
  {
    const ThreadLimit limit(1);
    run(folder_);
  }
  const auto first = testing::crowd_files(folder_.out());
  fs::remove_all(folder_.out());
  const ThreadLimit limit(5);
  run(folder_);
  EXPECT_THAT(testing::differing_files(first, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
}

TEST_F(OwnMaps, AreBlendedWhereColoursAreNot) {
  for (const std::string& name : folder_.names()) {
    folder_.folder().write(
        concat("heads/", name, ".mtl"),
        concat("newmtl skin\nKd 1 1 1\nmap_Kd ann.png\nnorm ", name, "_n.png\n"));
  }
  run(folder_, {"output.meshes=[obj, glb]", "output.contact_sheet={cell: 32}"});
  EXPECT_TRUE(fs::exists(meshes() / "ann.png"));
  EXPECT_FALSE(fs::exists(meshes() / "blended/mob_0001.png"));
  EXPECT_THAT(read_text(meshes() / "mob_0001.mtl"),
              HasSubstr("map_Kd ann.png\nnorm blended/mob_0001.normal.png\n"));
  EXPECT_THAT(read_text(meshes() / "mob_0001.glb"), HasSubstr("\"normalTexture\":{\"index\":0}"));
}

// Many programs name normals as map_Bump.
TEST_F(OwnMaps, ABumpMapOfNormalsIsBlendedAsNormals) {
  for (const std::string& name : folder_.names()) write_library(name, "map_Bump -bm 0.7");
  run(folder_);
  EXPECT_THAT(read_text(meshes() / "mob_0001.mtl"),
              HasSubstr("map_Bump -bm 0.7 blended/mob_0001.bump.png\n"));
  const Image normals = read_image(meshes() / "blended/mob_0001.bump.png");
  EXPECT_GT(normals.at(8, 8, 2), 0.9F);
  EXPECT_NEAR(normals.at(8, 8, 1), 0.5F, 0.01F);
}

TEST_F(OwnMaps, AMapThatOneHeadAloneHasIsToldNotToBeBlended) {
  for (const std::string& name : folder_.names()) {
    folder_.folder().write(concat("heads/", name, ".mtl"),
                           concat("newmtl skin\nKd 1 1 1\nmap_Kd ", name, ".png\n",
                                  name == "bob" ? "norm bob_n.png\n" : ""));
  }
  run(folder_);
  const auto warnings = testing::read_json(folder_.out() / "report.json").at("warnings").dump();
  EXPECT_THAT(warnings, HasSubstr("the normal texture of bob is not blended"));
  EXPECT_THAT(warnings, HasSubstr("(ann, cyd"));
}

TEST_F(OwnMaps, PicturesShowThem) {
  run(folder_, {"output.contact_sheet={cell: 64}"});
  const std::string shown = read_text(folder_.out() / "renders/mob_0002.png");
  // The sheet made again from what the folder holds is the same.
  fs::remove(folder_.out() / "renders/mob_0002.png");
  remake_sheets(folder_.out(), {}, folder_.cache());
  EXPECT_EQ(read_text(folder_.out() / "renders/mob_0002.png"), shown);
  for (const std::string& name : folder_.names()) {
    folder_.folder().write(concat("heads/", name, "_n.png"), normal_png(16, -0.5));
  }
  run(folder_, {"output.contact_sheet={cell: 64}"});
  EXPECT_NE(read_text(folder_.out() / "renders/mob_0002.png"), shown);
}

// Pictures showed the normals of the target alone.
TEST_F(OwnMaps, PicturesShowThemWhereColoursAreNotBlended) {
  for (const std::string colours : {"map_Kd ann.png\n", ""}) {
    for (const std::string& name : folder_.names()) {
      folder_.folder().write(concat("heads/", name, ".mtl"),
                             concat("newmtl skin\nKd 1 1 1\n", colours, "norm ", name, "_n.png\n"));
      folder_.folder().write(concat("heads/", name, "_n.png"), normal_png(16, 0.2));
    }
    // One head's differ, and no face is built on this head.
    const std::vector<std::string> set = {"output.contact_sheet={cell: 64}",
                                          "sampling.targets=[bob]", "sampling.sources=[ann]"};
    folder_.folder().write("heads/ann_n.png", normal_png(16, 0.3));
    run(folder_, set, Replace::kForce);
    const std::string shown = read_text(folder_.out() / "renders/mob_0002.png");
    fs::remove(folder_.out() / "renders/mob_0002.png");
    remake_sheets(folder_.out(), {}, folder_.cache());
    EXPECT_EQ(read_text(folder_.out() / "renders/mob_0002.png"), shown) << colours;
    folder_.folder().write("heads/ann_n.png", normal_png(16, -0.9));
    run(folder_, set, Replace::kForce);
    EXPECT_NE(read_text(folder_.out() / "renders/mob_0002.png"), shown) << colours;
  }
}

TEST_F(OwnMaps, WhatIsNoNormalMapIsRefused) {
  folder_.folder().write("heads/bob_n.png", grey_png(8, 200));
  testing::expect_error(ExitCode::kBadData, {"bob_n.png", "normal map"}, [&] { run(folder_); });
}

}  // namespace
}  // namespace crowdface
