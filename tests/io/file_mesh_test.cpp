// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/file_mesh.h"

#include <array>
#include <cstring>
#include <map>
#include <utility>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "crowdface/core/text.h"
#include "crowdface/io/fbx_reader.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/mesh/winding.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

template <class T>
std::string bytes_of_all(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

const std::string kPlyHead =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

TEST(ParsePly, ReadsPolygonsColoursAndTextureCoordinates) {
  const FileMesh mesh = parse_ply(
      "ply\r\nformat ascii 1.0\r\ncomment made by a program\r\nelement vertex 4\r\n"
      "property double x\r\nproperty double y\r\nproperty double z\r\nproperty float nx\r\n"
      "property uchar red\r\nproperty uchar green\r\nproperty uchar blue\r\nproperty float s\r\n"
      "property float t\r\nelement face 2\r\nproperty int flags\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n"
      "0 0 0 nan 255 0 51 0 0\r\n1 0 0 -nan(ind) 0 0 0 1 0\r\n1 1 0 0 0 0 0 1 1\r\n"
      "0 1 0 0 0 0 0 0 1\r\n7 4 0 1 2 3\r\n7 3 0 2 1\r\n",
      "head.ply");
  EXPECT_EQ(mesh.topology.face_offsets, (std::vector<std::uint32_t>{0, 4, 7}));
  EXPECT_EQ(mesh.topology.corner_vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 0, 2, 1}));
  EXPECT_EQ(mesh.topology.corner_uvs, mesh.topology.corner_vertices);
  EXPECT_EQ(mesh.uvs.row(3), Eigen::RowVector2d(0, 1));
  EXPECT_EQ(mesh.colours.row(0), Eigen::RowVector3d(1, 0, 0.2));
}

TEST(ParsePly, ReadsPropertiesInCapitals) {
  const FileMesh mesh = parse_ply(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float X\nproperty float Y\n"
      "property float Z\nproperty uchar Red\nproperty uchar Green\nproperty uchar Blue\n"
      "element face 1\nproperty list uchar int Vertex_Indices\nend_header\n"
      "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 5 255 0 0\n3 0 1 2\n",
      "head.ply");
  EXPECT_EQ(mesh.positions.row(2), Eigen::RowVector3d(0, 1, 5));
  EXPECT_EQ(mesh.colours.row(2), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(mesh.topology.face_count(), 1);
}

TEST(ParsePly, ReadsStripsAndLinesThatEndInCr) {
  std::string text = "ply\nformat ascii 1.0\n" + kPlyHead +
                     "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3\n";
  for (const char end : {'\n', '\r'}) {
    std::ranges::replace(text, '\n', end);
    const FileMesh mesh = parse_ply(text, "strip.ply");
    EXPECT_EQ(mesh.topology.corner_vertices,
              (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 0, 1, 3}));
  }
}

TEST(ParsePly, ReadsTextureCoordinatesOfCorners) {
  const FileMesh mesh =
      parse_ply("ply\nformat ascii 1.0\ncomment TextureFile skin.png\n" + kPlyHead +
                    "element face 1\nproperty list uchar int vertex_indices\n"
                    "property list uchar float texcoord\nend_header\n"
                    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 6 0.5 0 1 0 0 1\n",
                "wedge.ply");
  EXPECT_EQ(mesh.topology.corner_uvs, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(mesh.uvs.row(0), Eigen::RowVector2d(0.5, 0));
}

TEST(ParsePly, ReadsTexturesThatCommentsName) {
  const TemporaryFolder folder;
  folder.write("skin 1.png", "first");
  folder.write("tex/Eyes.png", "second");
  const std::string text = "ply\nformat ascii 1.0\ncomment TextureFile skin 1.png\n" + kPlyHead +
                           "comment TextureFile C:\\scan\\eyes.png\nelement face 3\n"
                           "property list uchar int vertex_indices\nproperty int texnumber\n"
                           "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
                           "3 0 1 2 1\n3 2 1 3 0\n3 2 1 0 0\n";
  const FileMesh mesh = parse_ply(text, (folder / "head.ply").string());
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.materials[0].name, "texture_2");
  EXPECT_EQ(mesh.materials[1].name, "texture_1");
  EXPECT_EQ(mesh.materials[1].first_face, 1);
  ASSERT_EQ(mesh.textures.size(), 2U);
  EXPECT_EQ(mesh.textures[0].bytes, "first");
  EXPECT_EQ(mesh.textures[1].bytes, "second");
}

// MeshLab once wrote a list of colours that its header did not name, and Blender a comment without
// the word "comment".
TEST(ParsePly, ReadsTextWhoseLinesAreLongerThanItsHeaderSays) {
  const std::string head = "ply\nformat ascii 1.0\nCreated by a program\n" + kPlyHead +
                           "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n\n";
  const FileMesh mesh = parse_ply(head + "3 0 1 2 6 3 3 3 1 1 1\r\n3 2 1 3\n", "head.ply");
  EXPECT_EQ(mesh.topology.corner_vertices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
  EXPECT_THAT(mesh.notes,
              ::testing::ElementsAre(::testing::HasSubstr("\"Created by a program\""),
                                     ::testing::HasSubstr("1 of its lines have more numbers")));
  expect_error(ExitCode::kBadData, {"line 16 has fewer numbers"},
               [&] { parse_ply(head + "3 0 1\n3 2 1 3\n", "head.ply"); });
  // PLY allows several elements in one line.
  EXPECT_EQ(parse_ply(head + "3 0 1 2 3 2 1 3\n", "head.ply").topology.face_count(), 2);
}

TEST(ParsePly, SaysWhyItRefuses) {
  const auto refuse = [](const std::string& text, const char* reason) {
    expect_error(ExitCode::kBadData, {reason}, [&] { parse_ply(text, "head.ply"); });
  };
  const std::string text = "ply\nformat ascii 1.0\n" + kPlyHead +
                           "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  refuse(text + "0,5 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n", "decimal point");
  refuse(text + "0 0 0\n1 0 0\n0 1 -", "ends too soon: copy or export it again");
  refuse("ply\nformat ascii 1.0\n" + kPlyHead + "property float f_dc_0\nend_header\n",
         "Gaussian splat");
}

std::string text_stl_of(const std::string& name, bool capitals) {
  std::string text = "solid " + name +
                     "\n facet normal nan 0 0\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n"
                     " vertex 0 1 1e-2\n endloop\n endfacet\nendsolid " +
                     name + "\n";
  if (capitals)
    std::ranges::transform(text, text.begin(),
                           [](char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

TEST(ParseStl, TakesAnyNameCaseAndLineEnd) {
  const FileMesh good = parse_stl(text_stl_of("head", false), "a.stl");
  ASSERT_EQ(good.topology.face_count(), 1);
  EXPECT_EQ(good.positions.row(2), Eigen::RowVector3d(0, 1, 0.01));
  std::string crlf = text_stl_of("head", false);
  for (std::size_t at = 0; (at = crlf.find('\n', at)) != crlf.npos; at += 2) crlf.insert(at, "\r");
  for (const std::string& text :
       {text_stl_of("HEAD", true), text_stl_of("head with vertex colour", false), crlf,
        "\n" + text_stl_of("", false)}) {
    const FileMesh mesh = parse_stl(text, "b.stl");
    EXPECT_EQ(mesh.positions, good.positions);
    EXPECT_EQ(mesh.topology.corner_vertices, good.topology.corner_vertices);
  }
}

TEST(ParseStl, TakesATextOfOneLine) {
  std::string line = text_stl_of("head", false) + text_stl_of("", true);
  std::ranges::replace(line, '\n', ' ');
  const FileMesh mesh = parse_stl(line, "line.stl");
  ASSERT_EQ(mesh.topology.face_count(), 2);
  EXPECT_EQ(mesh.positions.row(5), Eigen::RowVector3d(0, 1, 0.01));
}

TEST(ParseStl, SaysWhyItRefuses) {
  const std::string text = text_stl_of("head", false);
  expect_error(ExitCode::kBadData, {"decimal point"}, [&] {
    std::string commas = text;
    std::ranges::replace(commas, '0', ',');
    parse_stl(commas, "head.stl");
  });
  expect_error(ExitCode::kBadData, {"ends too soon"},
               [&] { parse_stl(text.substr(0, text.find("0 1 1e-2")), "head.stl"); });
}

TEST(ParseStl, BinaryFilesMayClaimOtherCounts) {
  std::string bytes = "solid made by a program";
  bytes.resize(80, '\0');
  bytes += bytes_of_all(std::vector<std::uint32_t>{2});
  for (int t = 0; t < 2; ++t) {
    bytes +=
        bytes_of_all(std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(2, '\0');
  }
  EXPECT_TRUE(parse_stl(bytes, "exact.stl").notes.empty());
  const FileMesh trailing = parse_stl(bytes + "xx", "trailing.stl");
  EXPECT_EQ(trailing.topology.face_count(), 2);
  EXPECT_THAT(trailing.notes,
              ::testing::ElementsAre("2 bytes after its last triangle are not read"));
  for (const char claimed : {'\0', '\x09'}) {
    std::string other = bytes;
    other[80] = claimed;
    EXPECT_EQ(parse_stl(other, "count.stl").topology.face_count(), 2);
  }
  expect_error(ExitCode::kBadData, {"cut.stl", "claims"},
               [&] { parse_stl(bytes.substr(0, bytes.size() - 1), "cut.stl"); });
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

TEST(JoinSplitVertices, GivesOurOwnFilesTheirVerticesBack) {
  // A cube whose faces have texture coordinates of their own: three vertices stand in each corner.
  Topology topology = cube_topology();
  TextureCoordinates uvs(topology.corner_count(), 2);
  for (std::uint32_t c = 0; c < topology.corner_vertices.size(); ++c) {
    topology.corner_uvs.push_back(c);
    uvs.row(c) << c / 32.0, 1 - c / 64.0;
  }
  const Positions positions = cube_positions();
  const TemporaryFolder folder;
  GlbTemplate(topology, uvs, GlbOptions())
      .encode(positions, positions, "cube")
      .write(folder / "cube.glb");
  FileMesh split = read_mesh(folder / "cube.glb");
  EXPECT_GT(split.positions.rows(), 8);
  for (const bool by_place : {false, true}) {
    FileMesh joined = split;
    if (by_place) joined.vertex_ids.clear();
    join_split_vertices(joined);
    EXPECT_EQ(joined.topology.vertex_count, 8);
    EXPECT_LT((joined.positions - positions).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(joined.topology.face_count(), 12);
    for (std::size_t c = 0; c < joined.topology.corner_uvs.size(); ++c) {
      EXPECT_NE(joined.topology.corner_uvs[c], kNoIndex);
    }
  }
  const ObjFile head = read_mesh_as_obj(folder / "cube.glb");
  EXPECT_EQ(head.topology.vertex_count, 8);
  EXPECT_TRUE(head.is_mended);
  EXPECT_EQ(head.notes.size(), 1U);
}

TEST(RightSideOut, TurnsFacesInTheTextToo) {
  const std::string vertices =
      "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nv 0 0 1\r\nvt 0 0\r\nvt 1 0\r\nvt 0 1\r\n";
  const std::string inside_out = vertices +
                                 "g left\r\nf 1/1 2/2 3/3\r\n f 1 4 2\r\nf 1 3 4\r\n"
                                 "f -3/1 -1/2 -2/3";
  const TemporaryFolder folder;
  const ObjFile turned = read_mesh_as_obj(folder.write("in.obj", inside_out));
  EXPECT_EQ(turned.file.bytes(), vertices +
                                     "g left\r\nf 1/1 3/3 2/2\r\nf 1 2 4\r\nf 1 4 3\r\n"
                                     "f -3/1 -2/3 -1/2");
  EXPECT_EQ(winding_sign(turned.topology, turned.positions), 1);
  EXPECT_TRUE(turned.is_mended);
  EXPECT_EQ(turned.notes.size(), 1U);
  const auto outward = folder.write("out.obj", turned.file.bytes());
  EXPECT_EQ(read_mesh_as_obj(outward).notes.size(), 0U);
}

TEST(ReadMesh, TellsFormatsByWhatTheyHoldAndWhatIsNone) {
  const TemporaryFolder folder;
  const std::string ply = "ply\nformat ascii 1.0\n" + kPlyHead +
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_mesh(folder.write("called.stl", ply)).topology.face_count(), 1);
  const auto refuse = [&](const char* name, const std::string& bytes, const char* phrase) {
    expect_error(ExitCode::kBadData, {name, phrase}, [&] { read_mesh(folder.write(name, bytes)); });
  };
  refuse("page.glb", "\n<!DOCTYPE html>\n<html>", "web page");
  refuse("page.ply", "<html><head>", "web page");
  refuse("pointer.stl", "version https://git-lfs.github.com/spec/v1\n", "Git LFS");
  refuse("packed.ply", "PK\x03\x04zip", "ZIP");
  std::string archive = std::string("PK\x03\x04").append(22, '\0') + "\x0c" + std::string(3, '\0');
  refuse("ann.npz", archive + "vertices.npy" + "\x93NUMPY",
         "numpy.save(\"ann.npy\", numpy.load(\"ann.npz\")[\"vertices\"])");
  refuse("empty.glb", "", "empty");
  refuse("scene.usdc", "PXR-USDC", "usdcat");
  refuse("scene.usdz", "PK\x03\x04zip", "usdz");
}

}  // namespace
}  // namespace crowdface::testing
