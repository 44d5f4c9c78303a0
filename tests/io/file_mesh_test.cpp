// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/file_mesh.h"

#include <algorithm>
#include <cctype>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/mesh/winding.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

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
  append_number(bytes, std::uint32_t{2});
  for (int t = 0; t < 2; ++t) {
    for (const float number : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) append_number(bytes, number);
    bytes += std::string(2, '\0');
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
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
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
