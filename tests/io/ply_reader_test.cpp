// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

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

}  // namespace
}  // namespace crowdface::testing
