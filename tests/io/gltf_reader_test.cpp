// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstring>
#include <utility>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

template <class T>
std::string bytes_of_all(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A glTF file of one triangle strip or so, its buffer as base64 beside the JSON.
std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (unsigned k = 0; k < 4; ++k) {
      out += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63U];
    }
  }
  return out;
}

struct GltfParts {
  std::string node = R"({"mesh":0})", primitive = R"({"attributes":{"POSITION":0},"indices":1})",
              accessors, views, more, weights;
  std::string data;
  std::string uri;  ///< of the buffer; empty: the data stand in the JSON text
};

FileMesh mesh_of(const GltfParts& parts, const std::filesystem::path& path = "scene.gltf") {
  return parse_gltf(
      concat(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)",
             parts.node, R"(],"meshes":[{"primitives":[)", parts.primitive, "]", parts.weights,
             R"(}],"accessors":[)", parts.accessors, R"(],"bufferViews":[)", parts.views, R"(],)",
             parts.more, R"("buffers":[{"uri":")",
             parts.uri.empty() ? "data:application/octet-stream;base64," + base64(parts.data)
                               : parts.uri,
             R"(","byteLength":)", parts.data.size(), "}]}"),
      path);
}

const std::vector<float> kPlaces = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5F};
const std::vector<std::uint16_t> kCorners = {0, 1, 2, 2, 1, 3};
const std::string kIndices = R"({"bufferView":1,"componentType":5123,"type":"SCALAR","count":6})";

GltfParts plain_parts() {
  GltfParts parts;
  parts.accessors = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4},)" + kIndices;
  parts.data = bytes_of_all(kPlaces) + bytes_of_all(kCorners);
  parts.views = R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12})";
  return parts;
}

void expect_square(const FileMesh& mesh, double tolerance) {
  ASSERT_EQ(mesh.positions.rows(), 4);
  for (Index i = 0; i < 12; ++i) {
    EXPECT_NEAR(mesh.positions.data()[i], static_cast<double>(kPlaces[static_cast<std::size_t>(i)]),
                tolerance);
  }
  EXPECT_EQ(mesh.topology.corner_vertices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
}

TEST(ParseGltf, ReadsIntegersThatANodeScales) {
  expect_square(mesh_of(plain_parts()), 0);
  GltfParts parts = plain_parts();
  std::vector<std::int16_t> whole;
  for (std::size_t v = 0; v < 4; ++v) {
    for (std::size_t c = 0; c < 4; ++c) {
      whole.push_back(static_cast<std::int16_t>(c < 3 ? kPlaces[3 * v + c] * 32767 : 0));
    }
  }
  parts.data = bytes_of_all(whole) + bytes_of_all(kCorners);
  parts.views =
      R"({"buffer":0,"byteLength":32,"byteStride":8},{"buffer":0,"byteOffset":32,"byteLength":12})";
  const std::string accessor = R"({"bufferView":0,"componentType":5122,"type":"VEC3","count":4)";
  parts.accessors = accessor + R"(,"normalized":true},)" + kIndices;
  expect_square(mesh_of(parts), 1e-4);
  parts.accessors = accessor + "}," + kIndices;
  parts.node =
      concat(R"({"mesh":0,"scale":[)", 1.0 / 32767, ',', 1.0 / 32767, ',', 1.0 / 32767, "]}");
  expect_square(mesh_of(parts), 1e-4);
}

// Eyes, lashes and teeth are often one mesh that several nodes use.
TEST(ParseGltf, ReadsAMeshThatManyNodesUse) {
  GltfParts parts = plain_parts();
  for (int i = 0; i < 200; ++i) parts.node += R"(,{"mesh":0})";
  std::string children = "1";
  for (int i = 2; i <= 200; ++i) children += concat(",", i);
  parts.node = concat(R"({"mesh":0,"children":[)", children, "]}", parts.node.substr(10));
  EXPECT_EQ(mesh_of(parts).topology.face_count(), 2 * 201);
}

TEST(ParseGltf, NamesTheOldVersion) {
  expect_error(ExitCode::kBadData, {"old.gltf", "found version 1"},
               [] { parse_gltf(R"({"asset":{"version":"1.0"},"meshes":{}})", "old.gltf"); });
}

TEST(ParseGltf, RefusesUnknownRequiredExtensionsByName) {
  GltfParts parts = plain_parts();
  parts.more =
      R"("extensionsRequired":["KHR_materials_unlit","KHR_texture_basisu","VRMC_vrm","KHR_animation_pointer"],)";
  expect_square(mesh_of(parts), 0);
  parts.more = R"("extensionsRequired":["KHR_materials_unlit","XYZ_packed_mesh"],)";
  expect_error(ExitCode::kBadData, {"scene.gltf", "not read: XYZ_packed_mesh; export"},
               [&] { mesh_of(parts); });
}

// Meshes that an artist had hidden became part of the head.
TEST(ParseGltf, ReadsNoNodeThatIsHidden) {
  GltfParts parts = plain_parts();
  parts.more = R"("extensionsRequired":["KHR_node_visibility"],)";
  const auto hide = [](const char* value) {
    return concat(R"("extensions":{"KHR_node_visibility":{"visible":)", value, "}}");
  };
  const auto vertices = [&](const std::string& group, const std::string& child) {
    parts.node = concat(R"({"mesh":0,"children":[1]},{"children":[2],)", group,
                        R"(},{"mesh":0,"name":"cap",)", child, "}");
    const FileMesh mesh = mesh_of(parts);
    EXPECT_EQ(mesh.notes == std::vector<std::string>{"its hidden meshes are not used: cap"},
              mesh.positions.rows() == 4);
    return mesh.positions.rows();
  };
  EXPECT_EQ(vertices(hide("true"), hide("true")), 8);
  EXPECT_EQ(vertices(hide("true"), hide("false")), 4);
  EXPECT_EQ(vertices(hide("false"), hide("true")), 4);
  parts.node = concat(R"({"mesh":0,"name":"head",)", hide("false"), "}");
  expect_error(ExitCode::kBadData, {"scene.gltf: expected a mesh that is shown", "head; show"},
               [&] { mesh_of(parts); });
}

TEST(ParseGltf, FillsInSparseRows) {
  GltfParts parts = plain_parts();
  parts.data = bytes_of_all(kPlaces) + bytes_of_all(kCorners) +
               bytes_of_all(std::vector<std::uint32_t>{1}) +
               bytes_of_all(std::vector<float>{5, 6, 7});
  parts.views +=
      R"(,{"buffer":0,"byteOffset":60,"byteLength":4},{"buffer":0,"byteOffset":64,"byteLength":12})";
  const std::string sparse =
      R"(,"sparse":{"count":1,"indices":{"bufferView":2,"componentType":5125},"values":{"bufferView":3}}},)";
  parts.accessors =
      R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4)" + sparse + kIndices;
  FileMesh mesh = mesh_of(parts);
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(5, 6, 7));
  EXPECT_EQ(mesh.positions.row(3), Eigen::RowVector3d(1, 1, 0.5));
  parts.accessors = R"({"componentType":5126,"type":"VEC3","count":4)" + sparse + kIndices;
  mesh = mesh_of(parts);
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(5, 6, 7));
  EXPECT_EQ(mesh.positions.row(3), Eigen::RowVector3d(0, 0, 0));
}

TEST(ParseGltf, UnpacksMeshopt) {
  GltfParts parts = plain_parts();
  std::string places(meshopt_encodeVertexBufferBound(4, 12), '\0'), corners(200, '\0');
  const auto bytes = [](std::string& text) {
    return reinterpret_cast<unsigned char*>(text.data());
  };
  places.resize(meshopt_encodeVertexBuffer(bytes(places), places.size(), kPlaces.data(), 4, 12));
  const std::vector<std::uint32_t> wide(kCorners.begin(), kCorners.end());
  corners.resize(
      meshopt_encodeIndexBuffer(bytes(corners), corners.size(), wide.data(), wide.size()));
  ASSERT_FALSE(places.empty());
  ASSERT_FALSE(corners.empty());
  parts.data = places + corners;
  const auto view = [](std::size_t begin, std::size_t size, const std::string& how) {
    return concat(
        R"({"buffer":1,"byteLength":99,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)",
        begin, R"(,"byteLength":)", size, ",", how, "}}}");
  };
  const auto views = [&](std::size_t size) {
    return view(0, size, R"("byteStride":12,"count":4,"mode":"ATTRIBUTES")") + "," +
           view(places.size(), corners.size(), R"("byteStride":2,"count":6,"mode":"TRIANGLES")");
  };
  parts.views = views(places.size());
  expect_square(mesh_of(parts), 0);
  parts.views = views(places.size() / 2);
  expect_error(ExitCode::kBadData, {"scene.gltf", "EXT_meshopt_compression", "gltf-transform"},
               [&] { mesh_of(parts); });
}

TEST(ParseGltf, UnpacksDraco) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int positions =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (int f = 0; f < 2; ++f) {
    const auto at = [&](int c) {
      return &kPlaces[3U * kCorners[static_cast<std::size_t>(3 * f + c)]];
    };
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(static_cast<std::uint32_t>(f)),
                                      at(0), at(1), at(2));
  }
  const auto packed = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*packed, &buffer).ok());
  GltfParts parts = plain_parts();
  parts.data = std::string(buffer.data(), buffer.size());
  parts.views = concat(R"({"buffer":0,"byteLength":)", parts.data.size(), "}");
  parts.accessors =
      R"({"componentType":5126,"type":"VEC3","count":4},{"componentType":5123,"type":"SCALAR","count":6})";
  const std::string begin =
      R"({"attributes":{"POSITION":0},"indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":)";
  parts.primitive = concat(begin, packed->attribute(positions)->unique_id(), "}}}}");
  const FileMesh mesh = mesh_of(parts);
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.topology.face_count(), 2);
  EXPECT_NEAR(mesh.positions.col(2).maxCoeff(), 0.5, 1e-3);
  parts.primitive = begin + "77}}}}";
  expect_error(ExitCode::kBadData, {"Draco", "gltf-transform"}, [&] { mesh_of(parts); });
}

// Draco meshes kept the pose of their vertices whatever the joints, and lost their colours.
class DracoColours : public ::testing::TestWithParam<bool> {};
TEST_P(DracoColours, AndSkinsAreUnpacked) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int positions =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  const int weights = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
  const int colours =
      builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, GetParam());
  const std::array<std::uint8_t, 4> second = {1, 0, 0, 0}, red = {255, 0, 0, 255};
  const std::array<float, 4> whole = {1, 0, 0, 0};
  for (std::uint32_t f = 0; f < 2; ++f) {
    const auto at = [&](std::uint32_t c) { return &kPlaces[3U * kCorners[3 * f + c]]; };
    const draco::FaceIndex face(f);
    builder.SetAttributeValuesForFace(positions, face, at(0), at(1), at(2));
    builder.SetAttributeValuesForFace(joints, face, second.data(), second.data(), second.data());
    builder.SetAttributeValuesForFace(weights, face, whole.data(), whole.data(), whole.data());
    builder.SetAttributeValuesForFace(colours, face, red.data(), red.data(), red.data());
  }
  const auto packed = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*packed, &buffer).ok());
  GltfParts parts = plain_parts();
  parts.node = R"({"children":[1,2]},{"translation":[0,4,0]},{"mesh":0,"skin":0,"scale":[9,9,9]})";
  parts.more = R"("skins":[{"joints":[0,1]}],)";
  parts.data = std::string(buffer.data(), buffer.size());
  parts.views = concat(R"({"buffer":0,"byteLength":)", parts.data.size(), "}");
  parts.accessors =
      R"({"componentType":5126,"type":"VEC3","count":4},{"componentType":5123,"type":"SCALAR","count":6},)"
      R"({"componentType":5121,"type":"VEC4","count":4,"normalized":true})";
  const auto id = [&](int attribute) { return packed->attribute(attribute)->unique_id(); };
  parts.primitive = concat(
      R"({"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":)",
      id(positions), R"(,"JOINTS_0":)", id(joints), R"(,"WEIGHTS_0":)", id(weights),
      R"(,"COLOR_0":)", id(colours), "}}}}");
  const FileMesh mesh = mesh_of(parts);
  ASSERT_EQ(mesh.positions.rows(), 4);
  EXPECT_NEAR(mesh.positions.col(1).minCoeff(), 4, 1e-3);
  ASSERT_EQ(mesh.colours.rows(), 4);
  EXPECT_LT((mesh.colours.row(0) - Eigen::RowVector3d(1, 0, 0)).norm(), 1e-6);
}
INSTANTIATE_TEST_SUITE_P(NormalizedOrNot, DracoColours, ::testing::Bool());

TEST(ParseGltf, TurnsTextureCoordinatesAsMaterialsAsk) {
  GltfParts parts = plain_parts();
  parts.primitive =
      R"({"attributes":{"POSITION":0,"TEXCOORD_1":2,"COLOR_0":3},"indices":1,"material":0})";
  parts.accessors +=
      R"(,{"bufferView":2,"componentType":5126,"type":"VEC2","count":4})"
      R"(,{"bufferView":3,"componentType":5121,"normalized":true,"type":"VEC4","count":4})";
  parts.data += bytes_of_all(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}) + std::string(16, '\xff');
  parts.views +=
      R"(,{"buffer":0,"byteOffset":60,"byteLength":32},{"buffer":0,"byteOffset":92,"byteLength":16})";
  parts.more =
      R"("images":[{"uri":"data:image/png;base64,iVBORw=="}],"textures":[{"source":0}],"materials":[{"name":"Skin","pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
      R"("extensions":{"KHR_texture_transform":{"texCoord":1,"offset":[0.25,0.5],"scale":[0.5,0.25]}}}}}],)";
  const FileMesh mesh = mesh_of(parts);
  ASSERT_EQ(mesh.uvs.rows(), 4);
  EXPECT_EQ(mesh.uvs.row(0), Eigen::RowVector2d(0.25, 0.5));
  EXPECT_EQ(mesh.uvs.row(3), Eigen::RowVector2d(0.75, 0.25));
  EXPECT_EQ(mesh.colours.row(2), Eigen::RowVector3d(1, 1, 1));
  ASSERT_EQ(mesh.materials.size(), 1U);
  EXPECT_EQ(mesh.materials[0].name, "Skin");
  ASSERT_EQ(mesh.textures.size(), 1U);
  EXPECT_EQ(mesh.textures[0].material, "Skin");
  EXPECT_EQ(mesh.textures[0].kind, TextureKind::kColour);
  EXPECT_EQ(mesh.textures[0].bytes, "\x89PNG");
}

// Exporters write the paths of their own machine, and Windows ignores the case of names.
TEST(ParseGltf, FindsTexturesOfOtherMachines) {
  const TemporaryFolder folder;
  folder.write("textures/Skin 1.PNG", "sub");
  const auto texture_of = [&](const std::string& uri) {
    GltfParts parts = plain_parts();
    parts.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})";
    parts.more = concat(
        R"("images":[{"uri":")", uri,
        R"("}],"textures":[{"source":0}],"materials":[{"name":"Skin","normalTexture":{"index":0}}],)");
    return mesh_of(parts, folder / "head.gltf");
  };
  for (const char* uri : {"textures/Skin%201.PNG", "maps/skin%201.png", R"(textures\\skin 1.png)",
                          "C:/scans/Textures/Skin 1.png", "../../skin%201.png"}) {
    const FileMesh mesh = texture_of(uri);
    ASSERT_EQ(mesh.textures.size(), 1U) << uri;
    EXPECT_EQ(mesh.textures[0].bytes, "sub") << uri;
    EXPECT_TRUE(mesh.notes.empty()) << uri;
  }
  const FileMesh without = texture_of("other.png");
  EXPECT_TRUE(without.textures.empty());
  EXPECT_THAT(without.notes,
              ::testing::ElementsAre(::testing::HasSubstr("\"other.png\" is neither beside it")));
}

TEST(ParseGltf, FindsBuffersOfOtherMachines) {
  const TemporaryFolder folder;
  GltfParts parts = plain_parts();
  folder.write("Head.bin", parts.data);
  for (const char* uri :
       {R"(C:\\Users\\Anna\\head.bin)", "/scans/anna/head.bin", "../head.bin", "Head.bin"}) {
    parts.uri = uri;
    EXPECT_EQ(mesh_of(parts, folder / "head.gltf").topology.face_count(), 2) << uri;
  }
  parts.uri = "/scans/anna/other.bin";
  expect_error(ExitCode::kBadData, {"outside its folder", "/scans/anna/other.bin"},
               [&] { mesh_of(parts, folder / "head.gltf"); });
}

TEST(ParseGltf, AppliesTheDefaultWeightsOfMorphTargets) {
  GltfParts parts = plain_parts();
  parts.primitive =
      R"({"attributes":{"POSITION":0},"indices":1,"targets":[{"NORMAL":2},{"POSITION":2}]})";
  parts.accessors += R"(,{"bufferView":2,"componentType":5126,"type":"VEC3","count":4})";
  parts.data += bytes_of_all(std::vector<float>{0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0});
  parts.views += R"(,{"buffer":0,"byteOffset":60,"byteLength":48})";
  const auto y = [&] { return mesh_of(parts).positions(1, 1); };
  EXPECT_EQ(y(), 0);
  EXPECT_EQ(mesh_of(parts).notes.size(), 1U);
  parts.weights = R"(,"weights":[0,0.5])";
  EXPECT_EQ(y(), 1);
  EXPECT_THAT(mesh_of(parts).notes,
              ::testing::ElementsAre(::testing::HasSubstr("its 1 morph targets are not used")));
  parts.node = R"({"mesh":0,"weights":[1,-1]})";
  EXPECT_EQ(y(), -2);
  EXPECT_TRUE(mesh_of(parts).notes.empty());
  parts.node = R"({"mesh":0,"weights":[0,0]})";
  EXPECT_EQ(y(), 0);
  parts.node = R"({"mesh":0,"weights":[0,1]})";
  parts.accessors.back() = ' ';
  parts.accessors +=
      R"(,"sparse":{"count":0,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}})";
  EXPECT_EQ(y(), 2);
  parts.accessors.replace(parts.accessors.rfind(R"("count":4)"), 9, R"("count":3)");
  expect_error(ExitCode::kBadData, {"scene.gltf", "a morph target and POSITION differ in length"},
               [&] { mesh_of(parts); });
}

TEST(ParseGltf, PrimitivesThatShareVerticesKeepTheirTextureCoordinates) {
  GltfParts parts = plain_parts();
  parts.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1},)"
                    R"({"attributes":{"POSITION":0,"TEXCOORD_0":3},"indices":1},)"
                    R"({"attributes":{"POSITION":0,"TEXCOORD_0":3},"indices":1},)"
                    R"({"attributes":{"POSITION":0,"TEXCOORD_0":3},"indices":1,"material":0},)"
                    R"({"attributes":{"POSITION":0},"indices":1})";
  parts.accessors += R"(,{"bufferView":2,"componentType":5126,"type":"VEC2","count":4})"
                     R"(,{"bufferView":3,"componentType":5126,"type":"VEC2","count":4})";
  parts.data += bytes_of_all(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}) +
                bytes_of_all(std::vector<float>{0, 0, 0.5, 0, 0, 1, 0.5, 1});
  parts.views +=
      R"(,{"buffer":0,"byteOffset":60,"byteLength":32},{"buffer":0,"byteOffset":92,"byteLength":32})";
  parts.more =
      R"("materials":[{"name":"Skin","pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
      R"("extensions":{"KHR_texture_transform":{"offset":[0.25,0]}}}}}],)";
  const FileMesh mesh = mesh_of(parts);
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.uvs.rows(), 12);
  const auto& rows = mesh.topology.corner_uvs;
  ASSERT_EQ(rows.size(), 30U);
  EXPECT_EQ(mesh.uvs(rows[1], 0), 1);
  EXPECT_EQ(mesh.uvs(rows[7], 0), 0.5);
  EXPECT_EQ(rows[13], rows[7]);
  EXPECT_EQ(mesh.uvs(rows[19], 0), 0.75);
  EXPECT_EQ(rows[25], kNoIndex);
}

// Eyes that hang on a bone otherwise have another size than the skin.
TEST(ParseGltf, PlacesSkinnedVerticesByTheirJoints) {
  GltfParts parts = plain_parts();
  parts.node =
      R"({"children":[1,2],"scale":[0.5,0.5,0.5]},{"translation":[0,4,0]},{"mesh":0,"skin":0,"scale":[9,9,9]})";
  parts.primitive = R"({"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1})";
  parts.accessors += R"(,{"bufferView":2,"componentType":5121,"type":"VEC4","count":4})"
                     R"(,{"bufferView":3,"componentType":5126,"type":"VEC4","count":4})"
                     R"(,{"bufferView":4,"componentType":5126,"type":"MAT4","count":2})";
  parts.data += std::string({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  for (int v = 0; v < 4; ++v) parts.data += bytes_of_all(std::vector<float>{1, 0, 0, 0});
  parts.data += bytes_of_all(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  parts.data += bytes_of_all(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -3, 0, 1});
  parts.views +=
      R"(,{"buffer":0,"byteOffset":60,"byteLength":16},{"buffer":0,"byteOffset":76,"byteLength":64})"
      R"(,{"buffer":0,"byteOffset":140,"byteLength":128})";
  parts.more = R"("skins":[{"joints":[0,1],"inverseBindMatrices":4}],)";
  const FileMesh mesh = mesh_of(parts);
  ASSERT_EQ(mesh.positions.rows(), 4);
  EXPECT_LT((mesh.positions.row(3) - Eigen::RowVector3d(0.5, 1, 0.25)).norm(), 1e-12);
}

TEST(ParseGltf, ReadsStripsAndFans) {
  GltfParts parts = plain_parts();
  parts.primitive = R"({"attributes":{"POSITION":0},"mode":5})";
  EXPECT_EQ(mesh_of(parts).topology.corner_vertices,
            (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
  parts.primitive = R"({"attributes":{"POSITION":0},"mode":6})";
  EXPECT_EQ(mesh_of(parts).topology.corner_vertices,
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

}  // namespace
}  // namespace crowdface::testing
