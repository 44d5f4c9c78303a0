// SPDX-License-Identifier: Apache-2.0
// What a strict reader makes of these files: tests/cli/usd_reader_test.sh.
#include "crowdface/io/usda_template.h"

#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A triangle, a quad and a pentagon with a texture seam, of two materials.
struct Scene {
  Topology topology;
  TextureCoordinates uvs = TextureCoordinates::Constant(9, 2, 0.25);
  GlbOptions options;
  Positions positions = testing::random_positions(8, 1);
  Positions normals = testing::random_positions(8, 2).rowwise().normalized();
  std::vector<Displacements> moves;

  Scene() {
    topology.vertex_count = 8;
    topology.add_face(std::vector<std::uint32_t>{0, 1, 2}, std::vector<std::uint32_t>{0, 1, 2});
    topology.add_face(std::vector<std::uint32_t>{2, 1, 3, 4},
                      std::vector<std::uint32_t>{2, 1, 3, 4});
    topology.add_face(std::vector<std::uint32_t>{4, 3, 5, 6, 7},
                      std::vector<std::uint32_t>{8, kNoIndex, 5, 6, 7});
    for (Index i = 0; i < 9; ++i) uvs(i, 0) += 0.1 * static_cast<double>(i);
    options.unit = LengthUnit::kCentimetre;
    options.materials = {{"skin", {0.5F, 0.25F, 0.125F, 1}}, {"2 eyes", {1, 1, 1, 0}}};
    options.polygon_materials = {0, 1, 0};
    options.targets = {{"smile-L", {1, 4}}, {"smile.L", {0}}};
    moves = {{{1, 4}, testing::random_positions(2, 3)}, {{0}, testing::random_positions(1, 4)}};
  }
  std::string text(Subdivision subdivision = Subdivision::kNone) const {
    return UsdaTemplate(topology, uvs, options, subdivision)
        .encode(positions, normals, "7-up", moves)
        .text();
  }
};

/// The numbers after `key`, up to the bracket that closes them.
std::vector<double> numbers_of(const std::string& text, const std::string& key) {
  const std::size_t begin = text.find(key + " = [");
  EXPECT_NE(begin, std::string::npos) << key;
  std::string list = text.substr(begin + key.size() + 4);
  list.resize(list.find(']'));
  for (char& c : list) {
    if (c == '(' || c == ')' || c == ',') c = ' ';
  }
  std::istringstream words(list);
  std::vector<double> numbers;
  for (double number = 0; words >> number;) numbers.push_back(number);
  return numbers;
}

void expect_rows(const std::string& text, const std::string& key, const Positions& rows) {
  const std::vector<double> numbers = numbers_of(text, key);
  ASSERT_EQ(numbers.size(), static_cast<std::size_t>(rows.size())) << key;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(static_cast<float>(numbers[i]), static_cast<float>(rows.data()[i])) << key;
  }
}

TEST(UsdaTemplate, HoldsTheMesh) {
  const Scene scene;
  const std::string text = scene.text();
  EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
  EXPECT_THAT(text, HasSubstr("defaultPrim = \"_7_up\""));
  EXPECT_THAT(text, HasSubstr("metersPerUnit = 0.01\n"));
  EXPECT_THAT(text, HasSubstr("upAxis = \"Y\"\n"));
  EXPECT_THAT(text, HasSubstr("subdivisionScheme = \"none\""));
  expect_rows(text, "point3f[] points", scene.positions);
  expect_rows(text, "normal3f[] normals", scene.normals);
  EXPECT_THAT(numbers_of(text, "int[] faceVertexCounts"), ElementsAre(3, 4, 5));
  EXPECT_THAT(numbers_of(text, "int[] faceVertexIndices"),
              ElementsAre(0, 1, 2, 2, 1, 3, 4, 4, 3, 5, 6, 7));
  EXPECT_THAT(numbers_of(text, "int[] primvars:st:indices"),
              ElementsAre(0, 1, 2, 2, 1, 3, 4, 8, 9, 5, 6, 7))
      << "the corner without a texture coordinate has one of its own";
  EXPECT_EQ(numbers_of(text, "texCoord2f[] primvars:st").size(), 20U);
}

TEST(UsdaTemplate, BindsEachFaceToItsMaterial) {
  const std::string text = Scene().text();
  const std::size_t skin = text.find("def GeomSubset \"skin_faces\"");
  const std::size_t eyes = text.find("def GeomSubset \"_2_eyes_faces\"");
  ASSERT_LT(skin, eyes);
  EXPECT_THAT(numbers_of(text.substr(skin), "int[] indices"), ElementsAre(0, 2));
  EXPECT_THAT(numbers_of(text.substr(eyes), "int[] indices"), ElementsAre(1));
  EXPECT_THAT(text, HasSubstr("rel material:binding = </_7_up/materials/_2_eyes>"));
  EXPECT_THAT(text, HasSubstr("color3f inputs:diffuseColor = (0.5, 0.25, 0.125)"));
}

// Eyeballs of one material were blank.
TEST(UsdaTemplate, LaysAnOverlayOverTheMaterialsThatWantIt) {
  Scene scene;
  scene.options.materials[1] = {
      .name = "eye", .colour = {0.7F, 0.7F, 0.6F, 1}, .uses_overlay = true};
  scene.options.overlay.emplace();
  for (std::uint16_t v = 0; v < 8; ++v) scene.options.overlay->uvs.push_back({v, 65535});
  scene.options.overlay->uvs[3] = {65535, 0};
  const std::string text = scene.text();
  EXPECT_THAT(numbers_of(text, "int[] primvars:st1:indices"), ElementsAre(0, 2, 1, 3, 4, 0, 0, 0))
      << "of the second face alone";
  const std::vector<double> places = numbers_of(text, "texCoord2f[] primvars:st1");
  ASSERT_EQ(places.size(), 10U);
  EXPECT_NEAR(places[2], 2 / 65535.0, 1e-8);
  EXPECT_EQ(places[3], 0) << "the lower edge";
  EXPECT_EQ(places[6], 1);
  EXPECT_EQ(places[7], 1) << "the upper edge";
  const std::string eye = text.substr(text.find("def Material \"eye\""));
  EXPECT_THAT(eye, HasSubstr("asset inputs:file = @./topology/iris.png@"));
  EXPECT_THAT(eye, HasSubstr("string inputs:varname = \"st1\""));
  EXPECT_THAT(text.substr(0, text.size() - eye.size()), Not(HasSubstr("iris.png")));
}

TEST(UsdaTemplate, NamesTexturesBeside) {
  Scene scene;
  scene.options.polygon_materials = {0, 0, 0};
  scene.options.materials[0].image = 1;
  const UsdaTemplate form(scene.topology, scene.uvs, scene.options, Subdivision::kNone);
  const std::vector<std::string> images = {"./a.png", "./b.png"};
  const std::string text =
      form.encode(scene.positions, scene.normals, "x", scene.moves, images).text();
  EXPECT_THAT(text, HasSubstr("asset inputs:file = @./b.png@"));
  EXPECT_THAT(text, Not(HasSubstr("GeomSubset"))) << "one material is the whole mesh's";
}

// An @ in a file's name ended the asset path, and no reader could parse the layer.
TEST(UsdaTemplate, PutsNamesWithAnAtSignBetweenThreeOfThem) {
  Scene scene;
  scene.options.polygon_materials = {0, 0, 0};
  scene.options.materials[0].image = 0;
  const UsdaTemplate form(scene.topology, scene.uvs, scene.options, Subdivision::kNone);
  const auto layer = [&](const std::string& image) {
    return form.encode(scene.positions, scene.normals, "x", scene.moves, {&image, 1}).text();
  };
  EXPECT_THAT(layer("./a@2x.png"), HasSubstr("asset inputs:file = @@@./a@2x.png@@@\n"));
  EXPECT_THAT(layer("./a@@@b.png"), HasSubstr("asset inputs:file = @@@./a\\@@@b.png@@@\n"));
  EXPECT_THAT(layer("./a.png"), HasSubstr("asset inputs:file = @./a.png@\n"));
}

TEST(UsdaTemplate, HoldsShapesUnderTheirNames) {
  const Scene scene;
  const std::string text = scene.text();
  EXPECT_THAT(text, HasSubstr("skel:blendShapes = [\"smile-L\", \"smile.L\"]"));
  const std::size_t first = text.find("def BlendShape \"smile_L\"");
  const std::size_t second = text.find("def BlendShape \"smile_L_2\"");
  ASSERT_LT(first, second);
  expect_rows(text.substr(first), "uniform vector3f[] offsets", scene.moves[0].moves);
  EXPECT_THAT(numbers_of(text.substr(first), "uniform int[] pointIndices"), ElementsAre(1, 4));
  expect_rows(text.substr(second), "uniform vector3f[] offsets", scene.moves[1].moves);
  EXPECT_THAT(numbers_of(text, "float[] blendShapeWeights"), ElementsAre(0, 0));
}

TEST(UsdaTemplate, HoldsFurtherMeshesWithMaterialsOfTheirOwn) {
  const Scene scene;
  Topology triangle;
  triangle.vertex_count = 3;
  triangle.add_face(std::vector<std::uint32_t>{0, 1, 2});
  UsdaSurface surface;
  surface.colour_map = "./strands.png";
  surface.opacity_map = "./holes.png";
  const UsdaPart part("hair", triangle, {}, {{"a b", surface}}, {0}, {"smile-L", "smile.L"});
  const Positions positions = testing::random_positions(3, 5);
  const std::vector<Displacements> moves = {{{2}, testing::random_positions(1, 6)}, {{}, {}}};
  const PlacedUsdaPart placed{&part, &positions, moves};
  const std::string text =
      UsdaTemplate(scene.topology, scene.uvs, scene.options, Subdivision::kNone)
          .encode(scene.positions, scene.normals, "x", scene.moves, {}, {}, {&placed, 1})
          .text();
  expect_rows(text, "point3f[] points", scene.positions);
  const std::string hair = text.substr(text.find("def Mesh \"hair\""));
  expect_rows(hair, "point3f[] points", positions);
  EXPECT_THAT(hair, HasSubstr("skel:blendShapeTargets = [</x/face/hair/smile_L>, "
                              "</x/face/hair/smile_L_2>]"));
  EXPECT_THAT(hair, HasSubstr("skel:skeleton = </x/face/skeleton>"));
  EXPECT_THAT(numbers_of(hair, "uniform int[] pointIndices"), ElementsAre(2));
  EXPECT_THAT(hair, HasSubstr("rel material:binding = </x/hair_materials/a_b>"));
  const std::string materials = hair.substr(hair.find("def Scope \"hair_materials\""));
  EXPECT_THAT(materials,
              HasSubstr("inputs:opacity.connect = </x/hair_materials/a_b/holes.outputs:r>"));
  EXPECT_THAT(materials, HasSubstr("inputs:opacityThreshold = 0.5"));
  EXPECT_THAT(materials, HasSubstr("asset inputs:file = @./holes.png@"));
}

TEST(UsdaTemplate, SaysHowItIsSubdivided) {
  const std::string text = Scene().text(Subdivision::kCatmullClark);
  EXPECT_THAT(text, HasSubstr("subdivisionScheme = \"catmullClark\""));
  EXPECT_THAT(text, Not(HasSubstr("normals")));
}

TEST(UsdaTemplate, KeepsOrTurnsTheUpAxis) {
  Scene scene;
  scene.options.up = {2, 1};
  scene.options.front = {1, -1};
  EXPECT_THAT(scene.text(), HasSubstr("upAxis = \"Z\""));
  EXPECT_THAT(scene.text(), Not(HasSubstr("xformOp")));
  scene.options.up = {0, 1};
  scene.options.front = {2, -1};
  const std::string text = scene.text();
  EXPECT_THAT(text, HasSubstr("upAxis = \"Y\""));
  // Rows say where X, Y and Z go: up to Y, front to Z.
  EXPECT_THAT(text, HasSubstr("((0, 1, 0, 0), (1, 0, 0, 0), (0, 0, -1, 0), (0, 0, 0, 1))"));
}

TEST(UsdaTemplate, ReadsBack) {
  const testing::TemporaryFolder folder;
  const Scene scene;
  const Positions read =
      read_usda_positions(folder.write("face.usda", scene.text()), scene.positions.rows());
  EXPECT_EQ(read, scene.positions.cast<float>().cast<double>());
  const std::string good = scene.text();
  for (const std::string& bad : {std::string(), good.substr(0, 300), good.substr(300)}) {
    testing::expect_error(ExitCode::kBadData, {"bad.usda", "expected a USD layer"},
                          [&] { read_usda_positions(folder.write("bad.usda", bad), 8); });
  }
  for (const Index other : {7, 9}) {
    testing::expect_error(ExitCode::kBadData, {"face.usda"},
                          [&] { read_usda_positions(folder / "face.usda", other); });
  }
}

TEST(UsdaTemplate, HasTheSameBytesForAnyNumberOfThreads) {
  const Topology grid = testing::grid_topology(150, 150);  // several blocks
  const Positions positions = testing::random_positions(grid.vertex_count, 2);
  const UsdaTemplate form(grid, {}, {}, Subdivision::kNone);
  std::string first;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const std::string text = form.encode(positions, positions, "grid").text();
    if (first.empty()) first = text;
    EXPECT_TRUE(text == first) << threads << " threads";
  }
}

TEST(UsdaTemplate, RefusesWhatIsNotFinite) {
  Scene scene;
  scene.positions(3, 1) = std::numeric_limits<double>::infinity();
  testing::expect_error(ExitCode::kBadData, {"7-up"}, [&] { scene.text(); });
}

}  // namespace
}  // namespace crowdface
