// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/fbx_reader.h"

#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/read_mesh.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

/// FBX text of a square with the material `skin`.
/// \param textures  name of the material's property, and path of the image
std::string square_fbx(const std::vector<std::pair<std::string, std::string>>& textures,
                       std::string_view shape = {}) {
  std::string objects, links;
  int id = 10;
  for (const auto& [property, path] : textures) {
    objects += concat("Texture: ", id, ", \"Texture::t\", \"\" {\n FileName: \"", path,
                      "\"\n RelativeFilename: \"", path, "\"\n}\n");
    links += concat("C: \"OP\",", id++, ",3,\"", property, "\"\n");
  }
  if (!shape.empty()) {
    objects += concat(
        "Deformer: 4, \"Deformer::b\", \"BlendShape\" {\n}\n"
        "Deformer: 5, \"SubDeformer::",
        shape,
        "\", \"BlendShapeChannel\" {\n DeformPercent: 0\n FullWeights: *1 {\n a: 100\n }\n}\n"
        "Geometry: 6, \"Geometry::",
        shape,
        "\", \"Shape\" {\n Indexes: *1 {\n a: 0\n }\n Vertices: *3 {\n a: 0,0,1\n }\n"
        " Normals: *3 {\n a: 0,0,0\n }\n}\n");
    links += "C: \"OO\",4,1\nC: \"OO\",5,4\nC: \"OO\",6,5\n";
  }
  return concat(
      "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n"
      " FBXVersion: 7400\n}\nDefinitions:  {\n}\nObjects:  {\n"
      "Geometry: 1, \"Geometry::head\", \"Mesh\" {\n"
      " Vertices: *12 {\n a: 0,0,0,1,0,0,1,1,0,0,1,0\n }\n"
      " PolygonVertexIndex: *4 {\n a: 0,1,2,-4\n }\n"
      " LayerElementMaterial: 0 {\n MappingInformationType: \"AllSame\"\n"
      " ReferenceInformationType: \"IndexToDirect\"\n Materials: *1 {\n a: 0\n }\n }\n"
      " Layer: 0 {\n LayerElement:  {\n Type: \"LayerElementMaterial\"\n TypedIndex: 0\n }\n"
      " }\n}\nModel: 2, \"Model::head\", \"Mesh\" {\n}\n"
      "Material: 3, \"Material::skin\", \"\" {\n ShadingModel: \"phong\"\n}\n",
      objects, "}\nConnections:  {\nC: \"OO\",2,0\nC: \"OO\",1,2\nC: \"OO\",3,2\n", links, "}\n");
}

TEST(ParseFbx, TakesTexturesOfAllMaterials) {
  const TemporaryFolder folder;
  folder.write("colour.png", "colour");
  folder.write("normal.png", "normal");
  for (const auto& [colour, normal] :
       {std::pair("DiffuseColor", "NormalMap"), std::pair("Maya|baseColor", "Maya|normalCamera"),
        std::pair("Maya|TEX_color_map", "Maya|TEX_normal_map"),
        std::pair("3dsMax|Parameters|base_color_map", "3dsMax|Parameters|norm_map"),
        std::pair("3dsMax|main|base_color_map", "3dsMax|main|norm_map")}) {
    const FileMesh mesh = parse_fbx(square_fbx({{colour, "colour.png"},
                                                {normal, "normal.png"},
                                                {"Maya|specularRoughness", "colour.png"},
                                                {"Bump", "normal.png"},
                                                {"ReflectionFactor", "metal.png"}}),
                                    folder / "head.fbx");
    std::map<TextureKind, std::string> found;
    for (const MeshTexture& texture : mesh.textures) found[texture.kind] = texture.bytes;
    EXPECT_EQ(found, (std::map<TextureKind, std::string>{{TextureKind::kColour, "colour"},
                                                         {TextureKind::kNormal, "normal"},
                                                         {TextureKind::kRoughness, "colour"},
                                                         {TextureKind::kBump, "normal"}}))
        << colour;
    EXPECT_EQ(mesh.notes, std::vector<std::string>{
                              "its textures of these properties are not used: ReflectionFactor"});
  }
}

// Exporters write the paths of their own machine, and Windows ignores the case of names.
TEST(ParseFbx, FindsTexturesOfOtherMachines) {
  const auto texture_of = [](const TemporaryFolder& folder, const std::string& path) {
    const FileMesh mesh = parse_fbx(square_fbx({{"DiffuseColor", path}}), folder / "head.fbx");
    return mesh.textures.empty() ? std::string() : mesh.textures[0].bytes;
  };
  const TemporaryFolder folder;
  folder.write("textures/Skin.PNG", "sub");
  folder.write("head.fbm/made.png", "fbm");
  folder.write("other.fbm/made.png", "other");
  folder.write("a/twice.png", "a");
  folder.write("b/twice.png", "b");
  EXPECT_EQ(texture_of(folder, "C:\\proj\\Textures\\skin.png"), "sub");
  EXPECT_EQ(texture_of(folder, "..\\..\\maps\\SKIN.png"), "sub");
  EXPECT_EQ(texture_of(folder, "D:/maps/made.png"), "fbm");
  EXPECT_EQ(texture_of(folder, "D:/maps/twice.png"), "");
  EXPECT_EQ(texture_of(folder, "D:/B/twice.png"), "b");
}

TEST(ParseFbx, SaysThatShapesAreNotUsed) {
  const FileMesh mesh = parse_fbx(square_fbx({}, "smile"), "head.fbx");
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_TRUE(mesh.notes[0].starts_with("its 1 blend shapes are not used")) << mesh.notes[0];
}

TEST(ParseFbx, ReadsNoHiddenNodes) {
  std::string text = square_fbx({});
  text.insert(text.find("\"Mesh\" {\n}") + 9,
              " Properties70:  {\n  P: \"Show\", \"bool\", \"\", \"\",0\n }\n");
  expect_error(ExitCode::kBadData,
               {"head.fbx: expected a mesh that is shown", "its hidden meshes are not used: head"},
               [&] { parse_fbx(text, "head.fbx"); });
}

// 3ds Max writes a geometric offset for an object whose pivot was moved. The offset moves the
// object's mesh, and not the objects below it.
TEST(ParseFbx, AppliesAGeometricOffsetToItsOwnMeshOnly) {
  std::string text = square_fbx({});
  text.insert(text.find("\"Mesh\" {\n}") + 9,
              " Properties70:  {\n  P: \"GeometricTranslation\", \"Vector3D\", \"Vector\", "
              "\"\",10,0,0\n }\n");
  text.insert(text.find("Material: 3"), "Model: 20, \"Model::eye\", \"Mesh\" {\n}\n");
  text.insert(text.rfind('}'), "C: \"OO\",20,2\nC: \"OO\",1,20\nC: \"OO\",3,20\n");
  const FileMesh mesh = parse_fbx(text, "head.fbx");
  ASSERT_EQ(mesh.positions.rows(), 8);
  std::vector<double> left_ends;
  for (const Index first : {0, 4})
    left_ends.push_back(mesh.positions.col(0).segment(first, 4).minCoeff());
  std::ranges::sort(left_ends);
  EXPECT_EQ(left_ends, (std::vector<double>{0, 10}));
}

TEST(ParseFbx, SaysThatAFileHasNoMesh) {
  const TemporaryFolder folder;
  std::string text = square_fbx({});
  text.erase(text.find("Geometry: 1"), text.find("Model: 2") - text.find("Geometry: 1"));
  folder.write("camera.fbx", text);
  expect_error(ExitCode::kBadData, {"camera.fbx", "expected a mesh, found none: select the head"},
               [&] { read_mesh(folder / "camera.fbx"); });
}

}  // namespace
}  // namespace crowdface::testing
