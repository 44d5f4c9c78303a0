// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_textures.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/io/image.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::expect_error;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// Two quads, the second in the UDIM tile beside the first's.
constexpr const char* kHead =
    "mtllib head.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
    "vt 0 0\nvt 1 0\nvt 2 0\nvt 0 1\nvt 1 1\nvt 2 1\n"
    "usemtl skin left\nf 1/1 2/2 5/5 4/4\nusemtl right\nf 2/2 3/3 6/6 5/5\n";

void write_png(const TemporaryFolder& folder, const std::string& name, int side,
               std::array<std::uint8_t, 3> colour) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * side * side));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = colour[i % 3];
  folder.write(name, encode_png(side, side, 3, pixels));
}

struct Read {
  std::vector<ObjFile> files;
  HeadSet faces;
};

Read read(const TemporaryFolder& folder, const std::string& materials) {
  folder.write("head.mtl", materials);
  Read read;
  read.files.push_back(read_obj(folder.write("head.obj", kHead)));
  read.faces.topology = read.files[0].topology;
  read.faces.uvs = read.files[0].uvs;
  return read;
}

TEST(HeadTextures, WarningsNameHeadsAsTheCrowdDoes) {
  const TemporaryFolder folder;
  Read head = read(folder, "newmtl right\nmap_Kd gone.png\n");
  head.faces.heads.push_back({"ann", {}});
  EXPECT_THAT(find_texture_files(head.faces, head.files).front().warnings,
              ElementsAre(HasSubstr("(ann)")));
}

HeadTextures load(const Read& read, int max_px) {
  return load_render_textures(find_texture_files(read.faces, read.files).front(), max_px);
}

TEST(HeadTextures, ComeFromTheMaterialOfEachFaceInLinearLight) {
  const TemporaryFolder folder;
  write_png(folder, "tex/left.png", 2, {255, 0, 188});
  const Read head =
      read(folder, "newmtl skin left\nmap_Kd -clamp on tex\\left.png\nnewmtl right\n");
  const HeadTextures textures = load(head, 1024);
  ASSERT_EQ(textures.texture_sets.size(), 1U);
  const TextureSet& texture_set = textures.texture_sets[0];
  EXPECT_EQ(texture_set.texture_of_polygon, (std::vector<std::uint32_t>{0, TextureSet::kNone}));
  const LinearRgb colour = colour_at(*texture_set.textures[0], {0.5F, 0.5F});
  EXPECT_FLOAT_EQ(colour[0], 1);
  EXPECT_FLOAT_EQ(colour[1], 0);
  EXPECT_NEAR(colour[2], 0.5029, 1e-3) << "188 is half the light";
  EXPECT_TRUE(textures.warnings.empty());
}

TEST(HeadTextures, TilesAreToldByTheCoordinates) {
  const TemporaryFolder folder;
  write_png(folder, "skin.1001.png", 1, {255, 0, 0});
  write_png(folder, "skin.1002.png", 4, {0, 255, 0});
  const Read head = read(folder,
                         "newmtl skin left\nmap_Kd skin.<UDIM>.png\n"
                         "newmtl right\nmap_Kd skin.<UDIM>.png\n");
  const HeadTextures textures = load(head, 2);
  EXPECT_EQ(textures.texture_sets[0].texture_of_polygon, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_FLOAT_EQ(colour_at(*textures.texture_sets[0].textures[1], {1.5F, 0.5F})[1], 1);
  EXPECT_EQ(textures.texture_sets[0].textures[1]->width, 2) << "made smaller";
}

TEST(HeadTextures, AMissingOneIsAWarning) {
  const TemporaryFolder folder;
  write_png(folder, "left.png", 1, {9, 9, 9});
  const Read one = read(folder, "newmtl skin left\nmap_Kd left.png\nnewmtl right\nmap_Kd no.png\n");
  const HeadTextures textures = load(one, 8);
  EXPECT_EQ(textures.texture_sets[0].texture_of_polygon[1], TextureSet::kNone);
  ASSERT_FALSE(textures.warnings.empty());
  EXPECT_THAT(textures.warnings.back(), HasSubstr("no.png"));
  const Read none = read(folder, "newmtl skin left\nnewmtl right\n");
  EXPECT_FALSE(find_texture_files(none.faces, none.files).front().has_files());
}

TEST(HeadTextures, OfMaterialsThatNoFaceUsesAreToldNotToBeShown) {
  const TemporaryFolder folder;
  write_png(folder, "a.png", 1, {255, 0, 0});
  for (const char* materials :
       {"newmtl face\nmap_Kd a.png\nnewmtl neck\n", "newmtl face\nmap_Kd a.png\n"}) {
    const HeadTextures textures = load(read(folder, materials), 1024);
    EXPECT_FALSE(textures.has_textures() && !textures.texture_sets[0].textures.empty());
    EXPECT_THAT(textures.warnings,
                ElementsAre(AllOf(HasSubstr("no polygon uses their materials \"face\""),
                                  HasSubstr("its materials are \"skin left\", \"right\" (head)"))));
  }
}

TEST(HeadTextures, ADamagedOneIsRefusedByName) {
  const TemporaryFolder folder;
  folder.write("left.png", "no picture");
  const Read head = read(folder, "newmtl skin left\nmap_Kd left.png\n");
  expect_error(ExitCode::kBadData, {"left.png"}, [&] { load(head, 8); });
}

/// Two heads, each with its own material file.
Digest digest_of(const TemporaryFolder& folder, const std::string& first,
                 const std::string& second) {
  Read both = read(folder, first);
  std::string text = kHead;
  folder.write("other.mtl", second);
  both.files.push_back(
      read_obj(folder.write("other.obj", text.replace(text.find("head.mtl"), 8, "other.mtl"))));
  return load(both, 8).digest;
}

/// The stored values of all maps, and how many maps lie in files of the cache.
std::pair<std::vector<std::vector<StoredValue>>, std::size_t> maps_of(const Read& read,
                                                                      const CacheFolder& cache) {
  const HeadTextures textures =
      load_blended_textures(read.faces, polygon_materials(read.files[0].materials, 2),
                            find_texture_files(read.faces, read.files).front(), 8, cache);
  std::vector<std::vector<StoredValue>> values;
  std::size_t mapped = 0;
  for (const auto& of_picture : textures.blended.maps) {
    for (const auto& map : of_picture) {
      values.emplace_back(map->stored().begin(), map->stored().end());
      if (map->mapped_file != nullptr) ++mapped;
    }
  }
  return {values, mapped};
}

TEST(HeadTextures, TheCacheHoldsTheMapsOfTheFiles) {
  const TemporaryFolder folder;
  write_png(folder, "one.png", 8, {200, 100, 50});
  write_png(folder, "left.png", 4, {10, 20, 30});
  write_png(folder, "right.png", 8, {60, 70, 80});
  Read heads = read(folder, "newmtl skin left\nmap_Kd one.png\nnewmtl right\nmap_Kd one.png\n");
  folder.write("other.mtl", "newmtl skin left\nmap_Kd left.png\nnewmtl right\nmap_Kd right.png\n");
  std::string text = kHead;
  heads.files.push_back(
      read_obj(folder.write("other.obj", text.replace(text.find("head.mtl"), 8, "other.mtl"))));
  heads.faces.heads.resize(2);
  const auto [expected, none] = maps_of(heads, {});
  EXPECT_EQ(none, 0U);
  ASSERT_GE(expected.size(), 2U);
  EXPECT_NE(expected[0], expected[1]);
  const TemporaryFolder cache;
  for (const char* when : {"written", "read"}) {
    const auto [values, mapped] = maps_of(heads, cache.path());
    EXPECT_EQ(values, expected) << when;
    EXPECT_EQ(mapped, values.size()) << when;
  }
  // Another picture of the same name and size
  write_png(folder, "left.png", 4, {90, 20, 30});
  EXPECT_EQ(maps_of(heads, cache.path()).first, maps_of(heads, {}).first);
  EXPECT_NE(maps_of(heads, cache.path()).first, expected);
  // Damaged entries are replaced
  for (const auto& entry : std::filesystem::directory_iterator(cache.path())) {
    std::filesystem::resize_file(entry.path(), 100);
  }
  EXPECT_EQ(maps_of(heads, cache.path()).first, maps_of(heads, {}).first);
}

// It held the files' names and contents in the order in which they were met, and nothing else.
TEST(HeadTextures, DigestKnowsWhichFaceOfWhichHeadWearsWhich) {
  const TemporaryFolder folder;
  write_png(folder, "red.png", 1, {200, 0, 0});
  write_png(folder, "blue.png", 1, {0, 0, 200});
  const std::string red_blue = "newmtl skin left\nmap_Kd red.png\nnewmtl right\nmap_Kd blue.png\n";
  const std::string blue_red = "newmtl skin left\nmap_Kd blue.png\nnewmtl right\nmap_Kd red.png\n";
  const std::string red = "newmtl skin left\nmap_Kd red.png\nnewmtl right\n";
  const std::string right_red = "newmtl skin left\nnewmtl right\nmap_Kd red.png\n";
  const std::vector<std::pair<std::string, std::string>> all = {
      {red_blue, red_blue}, {red_blue, blue_red}, {blue_red, red_blue}, {red_blue, red},
      {red_blue, ""},       {red, red},           {red, right_red},     {red, ""}};
  std::set<std::string> digests;
  for (const auto& [first, second] : all) {
    digests.insert(digest_of(folder, first, second).hex());
    EXPECT_EQ(digest_of(folder, first, second), digest_of(folder, first, second));
  }
  EXPECT_EQ(digests.size(), all.size());
}

TEST(HeadTextures, ANameTooLongForTheSystemIsThatOfNoFile) {
  const TemporaryFolder folder;
  write_png(folder, "left.png", 1, {9, 9, 9});
  const Read head = read(folder, "newmtl skin left\nmap_Kd left.png\nnewmtl right\nmap_Kd " +
                                     std::string(300, 'x') + ".png\n");
  const HeadTextures textures = load(head, 8);
  EXPECT_EQ(textures.texture_sets[0].texture_of_polygon,
            (std::vector<std::uint32_t>{0, TextureSet::kNone}));
  EXPECT_FALSE(textures.warnings.empty());
}

TEST(HeadTextures, WarningsOfASharedMaterialFileAreToldOnce) {
  const TemporaryFolder folder;
  write_png(folder, "left.png", 1, {9, 9, 9});
  Read heads = read(folder, "newmtl skin left\nmap_Kd left.png\nmap_Ks gone.png\n");
  heads.files.push_back(read_obj(folder.write("second.obj", kHead)));
  const HeadTextures textures = load(heads, 8);
  EXPECT_EQ(textures.texture_sets[0].texture_of_polygon,
            textures.texture_sets[1].texture_of_polygon);
  EXPECT_EQ(textures.warnings.size(), 1U);
}

// Each head has a material file of its own, as scans do. It was told for each head, and twice.
TEST(HeadTextures, MissingOnesAreToldOnceWhicheverFilesNameThem) {
  const TemporaryFolder folder;
  write_png(folder, "heads/left.png", 1, {9, 9, 9});
  for (const std::string name : {"a", "b", "c"}) {
    std::string text = kHead;
    folder.write("heads/" + name + ".obj", text.replace(text.find("head.mtl"), 8, name + ".mtl"));
    folder.write("heads/" + name + ".mtl",
                 "newmtl skin left\nmap_Kd left.png\nnewmtl right\nmap_Kd gone.png\n");
  }
  const auto config = folder.write(
      "config.yaml",
      "schema: 1\ncrowd: {name: t, count: 0}\nfaces: {directory: heads, units: cm, align: none}\n"
      "smoothing: {max_iterations: 4, levels: exact}\nbelievability: none\n"
      "recipes:\n  - {id: one, target: a, regions: {all: {weights: {b: 1}, iterations: 0, "
      "extrapolation: 1}}}\n"
      "output: {directory: out, contact_sheet: {cell: 32}, gallery: none}\n");
  const auto told = [&] {
    generate(config, {}, {folder / "cache", Replace::kForce, false});
    const auto report = testing::read_json(folder / "out/report.json");
    std::vector<std::string> of_it;
    for (const auto& warning : report.at("warnings")) {
      if (warning.get<std::string>().find("gone.png") != std::string::npos)
        of_it.push_back(warning);
    }
    return of_it;
  };
  EXPECT_THAT(told(), ElementsAre(AllOf(HasSubstr("missing"), HasSubstr("(a, b, c)"))));
  std::filesystem::remove(folder / "heads/left.png");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("(a, b, c)"))) << "where no texture is there";
}

TEST(HeadTextures, PicturesOfACrowdBearThem) {
  const TemporaryFolder folder;
  write_png(folder, "skin.png", 1, {250, 20, 20});
  folder.write("head.mtl", "newmtl skin left\nmap_Kd skin.png\nnewmtl right\nmap_Kd skin.png\n");
  folder.write("heads/head.mtl",
               "newmtl skin left\nmap_Kd skin.png\nnewmtl right\nmap_Kd skin.png\n");
  write_png(folder, "heads/skin.png", 1, {250, 20, 20});
  folder.write("heads/a.obj", kHead);
  folder.write("heads/b.obj", kHead);
  const auto config = folder.write(
      "config.yaml",
      "schema: 1\ncrowd: {name: t, count: 0}\nfaces: {directory: heads, units: cm, align: none}\n"
      "smoothing: {max_iterations: 4, levels: exact}\nbelievability: none\n"
      "recipes:\n  - {id: one, target: a, regions: {all: {weights: {a: 1}, iterations: 0, "
      "extrapolation: 1}}}\n"
      "output: {directory: out, contact_sheet: {cell: 32, texture: true}, gallery: none}\n");
  generate(config, {}, {folder / "cache", Replace::kRefuse, false});
  const Image image = read_image(folder / "out/renders/one.png");
  EXPECT_GT(image.at(16, 16, 0), image.at(16, 16, 1) + 0.3F) << "red";
}

}  // namespace
}  // namespace crowdface
