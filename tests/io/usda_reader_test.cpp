// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/io/usda_template.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kSquare =
    "int[] faceVertexCounts = [3, 3]\n int[] faceVertexIndices = [0, 1, 2, 2, 1, 3]\n"
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0.5)] (\n interpolation = "
    "\"vertex\"\n)\n";

FileMesh mesh_of(const std::string& body) {
  return parse_usda("#usda 1.0\n(\n upAxis = \"Y\"\n)\n" + body, "head.usda");
}

FileMesh square_with(const std::string& lines) {
  return mesh_of(
      concat("def Xform \"root\" {\n def Mesh \"skin\" {\n", kSquare, lines, "\n}\n}\n"));
}

TEST(ParseUsda, ReadsWhatWeWrite) {
  Topology topology = cube_topology();
  TextureCoordinates uvs(topology.corner_count(), 2);
  for (std::uint32_t c = 0; c < topology.corner_vertices.size(); ++c) {
    topology.corner_uvs.push_back(c);
    uvs.row(c) << c / 32.0, 1 - c / 64.0;
  }
  GlbOptions options;
  options.has_colours = true;
  options.materials = {{"skin"}, {"eyes"}};
  for (Index f = 0; f < topology.face_count(); ++f)
    options.polygon_materials.push_back(f < 2 ? 0 : 1);
  const Positions positions = cube_positions();
  ColourRows colours(8, 3);
  for (Index i = 0; i < colours.size(); ++i) colours.data()[i] = static_cast<std::uint8_t>(9 * i);
  const std::string text =
      UsdaTemplate(topology, uvs, options, Subdivision::kNone)
          .encode(positions, positions.rowwise().normalized(), "a cube", {}, {}, {}, {}, colours)
          .text();
  const FileMesh mesh = parse_usda(text, "cube.usda");
  EXPECT_TRUE(first_difference(topology, mesh.topology).empty());
  EXPECT_EQ(mesh.topology.corner_uvs, topology.corner_uvs);
  EXPECT_LT((mesh.uvs - uvs).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((mesh.positions - positions).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((255 * mesh.colours - colours.cast<double>()).cwiseAbs().maxCoeff(), 1e-3);
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.materials[0].name, "skin");
  EXPECT_EQ(mesh.materials[1].name, "eyes");
  EXPECT_EQ(mesh.materials[1].first_face, 2);
}

TEST(ParseUsda, StandsMeshesWhereTheirTransformsSay) {
  const FileMesh mesh = mesh_of(
      concat("def Xform \"head\" (kind = \"component\")\n{\n"
             " double3 xformOp:translate = (10, 0, 0)\n float xformOp:rotateY = 90\n"
             " double3 xformOp:translate:pivot = (1, 0, 0)\n float3 xformOp:scale = (2, 2, 2)\n"
             " uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:translate:pivot\", "
             "\"xformOp:rotateY\", \"xformOp:scale\", \"!invert!xformOp:translate:pivot\"]\n"
             " def Mesh \"skin\" {\n",
             kSquare, "}\n}\n"));
  // (p - pivot) doubled, turned from x to -z, and moved by pivot and 10.
  EXPECT_LT((mesh.positions.row(0) - Eigen::RowVector3d(11, 0, 2)).norm(), 1e-9);
  EXPECT_LT((mesh.positions.row(3) - Eigen::RowVector3d(12, 2, 0)).norm(), 1e-9);
}

// The transform of a prim was ignored if the prim's children stood before it.
TEST(ParseUsda, OrderOfPropertiesAndChildrenIsIrrelevant) {
  const FileMesh mesh =
      mesh_of(concat("def Xform \"head\"\n{\n def Mesh \"skin\" {\n", kSquare,
                     " double3 xformOp:translate = (0, 1, 0)\n"
                     " uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n"
                     " double3 xformOp:scale = (2, 2, 2)\n"
                     " uniform token[] xformOpOrder = [\"xformOp:scale\"]\n}\n"));
  EXPECT_EQ(mesh.positions.row(3), Eigen::RowVector3d(2, 4, 1));
}

TEST(ParseUsda, ResetXformStackIgnoresParents) {
  const auto mesh_in = [&](const std::string& order) {
    return mesh_of(
        concat("def Xform \"head\"\n{\n double3 xformOp:scale = (2, 2, 2)\n"
               " uniform token[] xformOpOrder = [\"xformOp:scale\"]\n def Xform \"in\"\n{\n"
               " double3 xformOp:translate = (0, 1, 0)\n uniform token[] xformOpOrder = [",
               order, "]\n def Mesh \"skin\" {\n", kSquare, "}\n}\n}\n"));
  };
  EXPECT_EQ(mesh_in("\"xformOp:translate\"").positions.row(3), Eigen::RowVector3d(2, 4, 1));
  EXPECT_EQ(mesh_in("\"!resetXformStack!\", \"xformOp:translate\"").positions.row(3),
            Eigen::RowVector3d(1, 2, 0.5));
}

TEST(ParseUsda, TurnsLeftHandedFacesAndReadsPrimvars) {
  const FileMesh mesh = square_with(
      "uniform token orientation = \"leftHanded\"\n"
      "texCoord2f[] primvars:UVMap = [(0, 0), (1, 0), (0.5, 1)] (interpolation = \"vertex\")\n"
      "int[] primvars:UVMap:indices = [0, 1, 2, 2]\n"
      "color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)] (\n"
      " interpolation = \"vertex\"\n)\nrel material:binding = </root/mtl/Skin_Mat>");
  EXPECT_THAT(mesh.topology.corner_vertices, ElementsAre(0, 2, 1, 2, 3, 1));
  EXPECT_THAT(mesh.topology.corner_uvs, ElementsAre(0, 2, 1, 2, 2, 1));
  EXPECT_EQ(mesh.uvs.row(2), Eigen::RowVector2d(0.5, 1));
  EXPECT_EQ(mesh.colours.row(2), Eigen::RowVector3d(0, 0, 1));
  EXPECT_EQ(mesh.materials.at(0).name, "Skin_Mat");
}

TEST(ParseUsda, PassesWhatIsNoMesh) {
  const FileMesh mesh = square_with(
      "# def Mesh \"comment\" {\n"
      "custom string note = \"\"\"a } \" brace\"\"\"\nasset file = @./a(b.png@\n"
      "point3f[] points.timeSamples = {\n 0: [(9, 9, 9)],\n}\n"
      "token outputs:surface\n"
      "variantSet \"lod\" = {\n \"high\" {\n def Mesh \"other\" { }\n }\n}\n"
      "over \"elsewhere\" { point3f[] points = [(1, 2, 3)] }");
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.topology.face_count(), 2);
}

TEST(ParseUsda, RefusesWhatHasNoMeshOfItsOwnOrIsBroken) {
  const auto refuse = [](const std::string& body, const char* phrase) {
    expect_error(ExitCode::kBadData, {"head.usda", phrase}, [&] { mesh_of(body); });
  };
  refuse("def Xform \"a\" (references = @b.usd@) { }", "--flatten");
  refuse("def Mesh \"a\" {", "ends within a prim");
  refuse("def Mesh \"a\" { point3f[] points = [(1, x, 2)] }",
         "expected numbers in points, found x");
  refuse(
      "def Mesh \"a\" { point3f[] points = [(1, 2, 3)] int[] faceVertexCounts = [3] "
      "int[] faceVertexIndices = [0, 0, 1] }",
      "an index below 1, found 1");
  refuse(
      "def Mesh \"a\" { point3f[] points = [(1, 2, 3)] int[] faceVertexCounts = [4] "
      "int[] faceVertexIndices = [0, 0, 0] }",
      "an index below 4, found 4");
}

TEST(ParseUsda, ReadsTheTexturesOfPreviewSurfaces) {
  const TemporaryFolder folder;
  folder.write("maps/skin.png", "colours");
  folder.write("bumps.png", "normals");
  const std::string body = concat(R"(#usda 1.0
def Xform "root" {
 def Mesh "skin" {
  rel material:binding = </root/looks/pale>
)",
                                  kSquare, R"( }
 def Scope "looks" {
  def Material "pale" {
   asset inputs:rough = @rough.png@
   token outputs:surface.connect = </root/looks/pale/surface.outputs:surface>
   def Shader "surface" {
    uniform token info:id = "UsdPreviewSurface"
    color3f inputs:diffuseColor.connect = </root/looks/pale/colour.outputs:rgb>
    normal3f inputs:normal.connect = </root/looks/pale/nodes/relief.outputs:rgb>
    float inputs:roughness.connect = </root/looks/pale/rough.outputs:r>
   }
   def Shader "colour" {
    uniform token info:id = "UsdUVTexture"
    asset inputs:file = @./maps/skin.png@ ( colorSpace = "sRGB" )
   }
   def NodeGraph "nodes" {
    def Shader "relief" {
     uniform token info:id = "UsdUVTexture"
     asset inputs:file = @C:\work\bumps.png@
    }
   }
   def Shader "rough" {
    uniform token info:id = "UsdUVTexture"
    asset inputs:file.connect = </root/looks/pale.inputs:rough>
   }
  }
 }
})");
  const FileMesh mesh = parse_usda(body, (folder / "head.usda").string());
  ASSERT_EQ(mesh.textures.size(), 2U);
  EXPECT_EQ(mesh.textures[0].material, "pale");
  EXPECT_EQ(mesh.textures[0].kind, TextureKind::kColour);
  EXPECT_EQ(mesh.textures[0].bytes, "colours");
  EXPECT_EQ(mesh.textures[1].kind, TextureKind::kNormal);
  EXPECT_EQ(mesh.textures[1].bytes, "normals");
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("\"rough.png\" is neither beside it")));
}

// Lightmaps and constant values are often alphabetically first.
TEST(ParseUsda, ChoosesTheTextureCoordinatesOfTheMaterial) {
  const auto uvs = [](const char* name, double u, const char* interpolation = "vertex") {
    return concat("texCoord2f[] primvars:", name, " = [(", u, ", 0), (", u, ", 1), (", u, ", 2), (",
                  u, ", 3)] (interpolation = \"", interpolation, "\")\n");
  };
  const auto first_u = [](const FileMesh& mesh) {
    return mesh.uvs(mesh.topology.corner_uvs[0], 0);
  };
  const std::string all = uvs("Lightmap", 1) + uvs("UVMap", 2) + uvs("st", 3);
  EXPECT_EQ(first_u(square_with(all)), 3);
  EXPECT_EQ(first_u(square_with(uvs("Lightmap", 1) + uvs("map1", 2))), 2);
  EXPECT_EQ(first_u(square_with(uvs("UVMap", 1) + uvs("st", 2, "constant"))), 1);
  EXPECT_EQ(first_u(square_with(uvs("UVMap", 1) + "texCoord2f[] primvars:st = None")), 1);
  EXPECT_EQ(first_u(square_with("float2[] primvars:a = [(1, 0), (1, 0), (1, 0), (1, 0)] ("
                                "interpolation = \"vertex\")\n" +
                                uvs("b", 2))),
            2);
  const auto material = [](const char* name, const char* varname) {
    return concat("def Material \"", name, "\" {\n token inputs:uvs = \"UVMap\"\n",
                  "def Shader \"surface\" { uniform token info:id = \"UsdPreviewSurface\"\n"
                  "color3f inputs:diffuseColor.connect = </m/colour.outputs:rgb> }\n"
                  "def Shader \"colour\" { uniform token info:id = \"UsdUVTexture\"\n"
                  "float2 inputs:st.connect = </m/moved.outputs:result> }\n"
                  "def Shader \"moved\" { uniform token info:id = \"UsdTransform2d\"\n"
                  "float2 inputs:in.connect = </m/reader.outputs:result> }\n"
                  "def Shader \"reader\" { uniform token info:id = \"UsdPrimvarReader_float2\"\n",
                  varname, " }\n}\n");
  };
  const FileMesh mesh = mesh_of(concat(
      "def Mesh \"skin\" {\n", kSquare, all, "rel material:binding = </m/eyes>\n",
      "def GeomSubset \"face\" { int[] indices = [1]\n rel material:binding = </m/face> }\n}\n",
      material("eyes", "string inputs:varname = \"Lightmap\""),
      material("face", "string inputs:varname.connect = </m/face.inputs:uvs>")));
  EXPECT_EQ(first_u(mesh), 1);
  EXPECT_EQ(mesh.uvs(mesh.topology.corner_uvs[3], 0), 2);
}

// The texture was read, but the transform between its reader and the texture was ignored.
TEST(ParseUsda, TransformsTextureCoordinatesAsTheMaterialAsks) {
  const FileMesh mesh = mesh_of(
      concat("def Mesh \"skin\" {\n", kSquare,
             "texCoord2f[] primvars:st = [(0.5, 0.25), (1, 0), (0, 1), (1, 1)] (interpolation = "
             "\"vertex\")\nrel material:binding = </m>\n}\ndef Material \"m\" {\n"
             "def Shader \"surface\" { uniform token info:id = \"UsdPreviewSurface\"\n"
             "color3f inputs:diffuseColor.connect = </m/colour.outputs:rgb> }\n"
             "def Shader \"colour\" { uniform token info:id = \"UsdUVTexture\"\n"
             "float2 inputs:st.connect = </m/moved.outputs:result>\n"
             "float4 inputs:scale = (2, 2, 2, 1)\n}\n"
             "def Shader \"moved\" { uniform token info:id = \"UsdTransform2d\"\n"
             "float2 inputs:scale = (2, 4)\nfloat inputs:rotation = 90\n"
             "float2 inputs:translation = (0.5, 0)\n"
             "float2 inputs:in.connect = </m/reader.outputs:result> }\n"
             "def Shader \"reader\" { uniform token info:id = \"UsdPrimvarReader_float2\"\n"
             "string inputs:varname = \"st\" }\n}\n"));
  // (0.5, 0.25) is scaled to (1, 1), turned to (-1, 1), and moved.
  EXPECT_LT((mesh.uvs.row(mesh.topology.corner_uvs[0]) - Eigen::RowVector2d(-0.5, 1)).norm(),
            1e-12);
}

TEST(ParseUsda, ReadsNoMeshThatUsdHides) {
  const auto vertices = [](const char* metadata, const char* lines, const char* own = "") {
    const FileMesh mesh =
        mesh_of(concat("def Xform \"a\"", metadata, "{\n", lines, "\ndef Mesh \"extra\" {\n",
                       kSquare, own, "}\n}\ndef Mesh \"head\" {\n", kSquare, "}\n"));
    const bool is_noted = mesh.notes == std::vector<std::string>{
                                            "its meshes that are inactive, invisible, guides or "
                                            "proxies are not used: extra"};
    EXPECT_EQ(is_noted, mesh.positions.rows() == 4) << metadata << lines << own;
    return mesh.positions.rows();
  };
  EXPECT_EQ(vertices("(active = false)", ""), 4);
  EXPECT_EQ(vertices("", "token visibility = \"invisible\""), 4);
  EXPECT_EQ(vertices("", "", "token visibility = \"invisible\""), 4);
  EXPECT_EQ(vertices("", "uniform token purpose = \"guide\""), 4);
  EXPECT_EQ(vertices("", "", "uniform token purpose = \"proxy\""), 4);
  EXPECT_EQ(vertices("", "token visibility = \"inherited\""), 8);
  EXPECT_EQ(vertices("", "uniform token purpose = \"proxy\"", "uniform token purpose = \"render\""),
            8);
  EXPECT_EQ(vertices("(customData = { bool active = 0 })", ""), 8);
  expect_error(ExitCode::kBadData, {"head.usda", "expected a mesh that is shown, found only: a"},
               [] { mesh_of(concat("def Mesh \"a\" (active = 0) {\n", kSquare, "}")); });
}

TEST(ParseUsda, InheritsMaterialsFromParents) {
  const FileMesh mesh =
      mesh_of(concat("def Xform \"a\" {\n rel material:binding = </m/skin>\n def Xform \"b\" {\n"
                     "def Mesh \"face\" {\n",
                     kSquare, "}\n}\n def Mesh \"eyes\" {\n", kSquare,
                     "rel material:binding:preview = </m/iris>\n}\n}\n"));
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.materials[0].name, "skin");
  EXPECT_EQ(mesh.materials[1].name, "iris");
}

// Omniverse and Houdini bind some heads only for final renders; such heads had no materials.
TEST(ParseUsda, BindingsOfThePurposeFullCountLast) {
  const auto material = [](const std::string& root, const std::string& mesh) {
    return mesh_of(concat("def Xform \"a\" {\n", root, "\n def Mesh \"face\" {\n", kSquare, mesh,
                          "\n}\n}\n"))
        .materials.at(0)
        .name;
  };
  const std::string full = "rel material:binding:full = </m/mdl>";
  EXPECT_EQ(material("", full), "mdl");
  EXPECT_EQ(material(full, ""), "mdl");
  EXPECT_EQ(material("rel material:binding = </m/skin>", full), "skin");
  EXPECT_EQ(material(full, "rel material:binding:preview = </m/skin>"), "skin");
  EXPECT_EQ(material("rel material:binding:collection:full:x = [</a.collection:x>, </m/mdl>]\n"
                     "rel collection:x:includes = </a>",
                     ""),
            "mdl");
}

// The parts of a head that Houdini or Omniverse binds through collections had no materials.
TEST(ParseUsda, BindsMaterialsThroughCollections) {
  const auto materials = [](const std::string& root, const std::string& group = {}) {
    const FileMesh mesh = mesh_of(concat(
        "def Xform \"a\" {\n def Xform \"b\" {\n def Mesh \"face\" {\n", kSquare,
        "def GeomSubset \"lips\" { int[] indices = [1]\n uniform token familyName = \"x\" }\n"
        "}\n",
        group, "\n}\n def Mesh \"eyes\" {\n", kSquare, "}\n", root, "\n}\n"));
    std::vector<std::string> names;
    for (const MaterialRange& range : mesh.materials) names.push_back(range.name);
    return names;
  };
  const std::string skin =
      "rel material:binding = </m/rest>\n rel collection:skin:includes = [</a/b>]\n"
      "prepend rel material:binding:collection:skin = [</a.collection:skin>, </m/skin>]\n";
  EXPECT_THAT(materials(skin), ElementsAre("skin", "rest"));
  EXPECT_THAT(materials(skin + "rel collection:skin:excludes = </a/b/face>\n"),
              ElementsAre("rest"));
  EXPECT_THAT(materials(skin + "rel material:binding:collection:a = [</a.collection:lips>, "
                               "</m/lips>]\n rel collection:lips:includes = </a/b/face/lips>\n"),
              ElementsAre("skin", "lips", "rest"));
  EXPECT_THAT(materials(skin + "uniform token collection:skin:expansionRule = \"explicitOnly\""),
              ElementsAre("rest"));
  EXPECT_THAT(materials("rel material:binding:collection:all = [</a.collection:outer>, </m/all>]\n"
                        "rel collection:outer:includes = [</a.collection:inner>]\n"
                        "rel collection:inner:includes = [</a/eyes>, </a.collection:outer>]"),
              ElementsAre("face", "all"));
  EXPECT_THAT(materials("rel material:binding:collection:all = [</a.collection:all>, </m/all>]\n"
                        "uniform bool collection:all:includeRoot = 1"),
              ElementsAre("all"));
  const std::string near = "rel material:binding = </m/near>";
  EXPECT_THAT(materials(skin, near), ElementsAre("near", "rest"));
  EXPECT_THAT(materials("rel material:binding = </m/far> (\n bindMaterialAs = "
                        "\"strongerThanDescendants\"\n)",
                        near),
              ElementsAre("far"));
}

TEST(ParseUsda, ReadsTextureCoordinatesOfThreeNumbers) {
  const auto uvs = [](const char* type, const char* name) {
    return square_with(concat(type, "[] primvars:", name,
                              " = [(0, 0, 9), (0.5, 0, 9), (0, 1, 9), (1, 0.25, 9)] "
                              "(interpolation = \"vertex\")"))
        .uvs;
  };
  for (const auto& [type, name] : {std::pair("texCoord3f", "map_7"), std::pair("float3", "st"),
                                   std::pair("double3", "UVMap"), std::pair("half3", "uv")}) {
    const TextureCoordinates read = uvs(type, name);
    ASSERT_EQ(read.rows(), 4) << type;
    EXPECT_EQ(read.row(3), Eigen::RowVector2d(1, 0.25)) << type;
  }
  EXPECT_EQ(uvs("float3", "rest").rows(), 0);
  EXPECT_EQ(square_with("texCoord2h[] primvars:st = [(0, 0), (1, 0), (0, 1), (1, 1)] "
                        "(interpolation = \"vertex\")\nhalf2[] primvars:uv = [(0, 0)]")
                .uvs.rows(),
            4);
}

// Mouth and eyes were closed by polygons that USD does not show.
TEST(ParseUsda, ReadsNoPolygonThatIsAHole) {
  const FileMesh mesh = square_with("int[] holeIndices = [0]");
  EXPECT_THAT(mesh.topology.corner_vertices, ElementsAre(2, 1, 3));
  EXPECT_EQ(mesh.positions.rows(), 4);
  expect_error(ExitCode::kBadData, {"head.usda", "expected an index below 2, found 7"},
               [] { square_with("int[] holeIndices = [7]"); });
}

TEST(ParseUsda, ReadsTheFirstTimeSampleIfThereIsNoDefault) {
  const FileMesh mesh = mesh_of(
      "def Xform \"a\" {\n double3 xformOp:translate.timeSamples = { 1: (10, 0, 0), 2: (0, 0, 0) "
      "}\n"
      "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n def Mesh \"head\" {\n"
      "int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n"
      "point3f[] points.timeSamples = {\n -1.5 : [(0, 0, 1), (1, 0, 1), (0, 1, 1)],\n"
      "2: [(9, 9, 9)],\n}\n texCoord2f[] primvars:st (\n interpolation = \"vertex\"\n)\n"
      "texCoord2f[] primvars:st.timeSamples = { 1: [(0, 0), (0.5, 0), (0, 1)] }\n}\n}\n");
  ASSERT_EQ(mesh.positions.rows(), 3);
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(11, 0, 1));
  ASSERT_EQ(mesh.uvs.rows(), 3);
  EXPECT_EQ(mesh.uvs(1, 0), 0.5);
  EXPECT_THAT(mesh.notes, ElementsAre("its meshes are animated: the first time sample is used"));
  EXPECT_TRUE(square_with("point3f[] points.timeSamples = { 1: [(9, 9, 9)] }").notes.empty());
}

TEST(ParseUsda, ReadsByteOrderMarksAndCoordinatesInDoublePrecision) {
  const std::string body = concat(
      "#usda 1.0\ndef Mesh \"a\" {\n", kSquare,
      "double2[] primvars:st = [(0, 0), (1, 0), (0, 1), (1, 1)] (interpolation = \"vertex\")\n}\n");
  const FileMesh mesh = parse_usda("\xEF\xBB\xBF" + body, "head.usda");
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.uvs.rows(), 4);
}

TEST(ParseUsda, NamesTheListAndLineOfABadNumber) {
  expect_error(
      ExitCode::kBadData, {"head.usda:6: expected numbers in primvars:displayColor, found nan"},
      [] { mesh_of("def Mesh \"a\" {\n color3f[] primvars:displayColor = [(nan, 0, 0)]\n}"); });
}

}  // namespace
}  // namespace crowdface::testing
