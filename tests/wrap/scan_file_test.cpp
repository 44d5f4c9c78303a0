// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/wrap/wrap_template.h"
#include "head_models/synth/synthetic_head.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

Scan parse_glb(const std::string& bytes, const std::string& name) {
  const FileMesh mesh = parse_gltf(bytes, name);
  return {mesh.positions, triangles_of(mesh.topology)};
}

Scan cube() {
  return {cube_positions(), triangles_of(cube_topology())};
}

/// As a binary PLY file.
std::string encode_scan(const Scan& scan) {
  std::string bytes =
      concat("ply\nformat binary_little_endian 1.0\nelement vertex ", scan.positions.rows(),
             "\nproperty float x\nproperty float y\nproperty float z\nelement face ",
             scan.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
  const auto append = [&](const void* raw, std::size_t size) {
    bytes.append(static_cast<const char*>(raw), size);
  };
  const FloatPositions points = scan.positions.cast<float>();
  append(points.data(), sizeof(float) * static_cast<std::size_t>(points.size()));
  for (const Triangle& t : scan.triangles) {
    bytes += '\3';
    append(t.data(), sizeof t);
  }
  return bytes;
}

std::string binary_stl(const Scan& scan) {
  std::string bytes(84, ' ');
  const auto count = static_cast<std::uint32_t>(scan.triangles.size());
  std::memcpy(bytes.data() + 80, &count, 4);
  for (const Triangle& t : scan.triangles) {
    std::string record(50, '\0');
    for (std::size_t k = 0; k < 9; ++k) {
      const auto value = static_cast<float>(scan.positions(t[k / 3], static_cast<Index>(k % 3)));
      std::memcpy(record.data() + 12 + 4 * k, &value, 4);
    }
    bytes += record;
  }
  return bytes;
}

std::string text_stl(const Scan& scan) {
  std::string text = "solid cube\n";
  for (const Triangle& t : scan.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) {
      text += concat("vertex ", scan.positions(v, 0), ' ', scan.positions(v, 1), ' ',
                     scan.positions(v, 2), '\n');
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid cube\n";
}

/// A GLB file of one mesh, hung below a node that shifts it.
std::string glb(const Scan& scan, const std::string& node) {
  std::string binary;
  for (Index i = 0; i < scan.positions.size(); ++i) {
    const auto value = static_cast<float>(scan.positions.data()[i]);
    binary.append(reinterpret_cast<const char*>(&value), 4);
  }
  const std::size_t points = binary.size();
  for (const Triangle& t : scan.triangles) {
    for (const std::uint32_t v : t) {
      const auto corner = static_cast<std::uint16_t>(v);
      binary.append(reinterpret_cast<const char*>(&corner), 2);
    }
  }
  std::string json = concat(
      R"({"scenes":[{"nodes":[0]}],"nodes":[)", node,
      R"(,{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)",
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)",
      scan.positions.rows(), R"(},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":)",
      3 * scan.triangles.size(), R"(}],"bufferViews":[{"buffer":0,"byteLength":)", points,
      R"(},{"buffer":0,"byteOffset":)", points, R"(,"byteLength":)", binary.size() - points,
      R"(}],"buffers":[{"byteLength":)", binary.size(), "}]}");
  const auto pad = [](std::string& text, char with) {
    text.resize((text.size() + 3) / 4 * 4, with);
  };
  pad(json, ' ');
  pad(binary, '\0');
  const auto number = [](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&word), 4);
  };
  return "glTF" + number(2) + number(28 + json.size() + binary.size()) + number(json.size()) +
         "JSON" + json + number(binary.size()) + std::string("BIN\0", 4) + binary;
}

/// The three corners of each triangle.
std::vector<Eigen::RowVector3d> corners_of(const Scan& scan) {
  std::vector<Eigen::RowVector3d> corners;
  for (const Triangle& t : scan.triangles) {
    for (const std::uint32_t v : t) corners.emplace_back(scan.positions.row(v));
  }
  return corners;
}

TEST(MissingShare, IsOfTheSurfaceThatWouldCloseTheScan) {
  Scan scan = cube();
  EXPECT_NEAR(net_area_fraction(scan), 0, 1e-12);
  const auto count = scan.triangles.size();
  scan.triangles.resize(count - 2);  // five of six sides
  EXPECT_NEAR(net_area_fraction(scan), 0.2, 1e-12);
}

// Programs that wind triangles the other way, or mirror a scan, leave it inside out.
TEST(ReadScan, TurnsAScanThatIsInsideOut) {
  const TemporaryFolder folder;
  Scan inside_out = cube();
  for (Triangle& triangle : inside_out.triangles) std::swap(triangle[1], triangle[2]);
  for (const auto& [name, bytes] : {std::pair("in.stl", binary_stl(inside_out)),
                                    std::pair("in.ply", encode_scan(inside_out))}) {
    const Scan scan = read_scan(folder.write(name, bytes));
    EXPECT_EQ(join(scan.notes), "its faces pointed inward (inside out) and are flipped") << name;
    double volume = 0;
    for (const Triangle& t : scan.triangles) {
      volume += row3(scan.positions, t[0]).dot(area_vector(scan.positions, t));
    }
    EXPECT_GT(volume, 0) << name;
  }
  EXPECT_TRUE(read_scan(folder.write("out.stl", binary_stl(cube()))).notes.empty());
}

TEST(ScanFile, EveryFormatGivesTheSameSurface) {
  const TemporaryFolder folder;
  const Scan scan = cube();
  std::string text_ply =
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement vertex 8\r\n"
      "property double x\r\nproperty uchar red\r\nproperty double y\r\n"
      "property double z\r\nelement face 6\r\n"
      "property list uchar int vertex_index\r\nend_header\r\n";
  for (Index v = 0; v < 8; ++v) {
    text_ply += concat(scan.positions(v, 0), " 7 ", scan.positions(v, 1), ' ', scan.positions(v, 2),
                       "\r\n");
  }
  const Topology topology = cube_topology();
  for (Index f = 0; f < 6; ++f) {
    const auto face = topology.face(f);
    text_ply += concat("4 ", face[0], ' ', face[1], ' ', face[2], ' ', face[3], "\r\n");
  }
  const auto read = [&](const char* name, const std::string& bytes) {
    return corners_of(read_scan(folder.write(name, bytes)));
  };
  const auto expected = corners_of(scan);
  EXPECT_EQ(read("binary.ply", encode_scan(scan)), expected);
  EXPECT_EQ(read("text.PLY", text_ply), expected);
  EXPECT_EQ(read("binary.stl", binary_stl(scan)), expected);
  EXPECT_EQ(read("text.stl", text_stl(scan)), expected);
  EXPECT_EQ(read("scan.glb", glb(scan, R"({"children":[1]})")), expected);
}

TEST(ScanFile, CornersInOnePlaceAreWelded) {
  const TemporaryFolder folder;
  const Scan scan = read_scan(folder.write("cube.stl", binary_stl(cube())));
  const std::vector<bool> rim =
      build_adjacency(topology_of(scan.triangles, scan.positions.rows())).boundary;
  EXPECT_EQ(std::count(rim.begin(), rim.end(), true), 0) << "a cube is closed";
}

TEST(ScanFile, WhatTouchesASurfaceThatHangsTogetherIsNoneOfIt) {
  Scan scan = cube();
  const auto first = static_cast<std::uint32_t>(scan.positions.rows());
  Positions more(first + 3, 3);
  more << scan.positions, scan.positions.row(0), scan.positions.row(1),
      0.5 * (scan.positions.row(0) + scan.positions.row(1)) + Eigen::RowVector3d(0, 0, 0.3);
  scan.positions = more;
  scan.triangles.push_back({first, first + 1, first + 2});
  const Scan before = scan;
  weld_vertices(scan);
  EXPECT_EQ(scan.triangles, before.triangles);
}

TEST(ScanFile, LashesOfAHeadWithEyesAreLeftOut) {
  const SyntheticHeads heads(8000, SyntheticHeads::Parts::kEyesAndTeeth);
  const Scan head{heads.positions(1, 0), triangles_of(heads.topology())};
  const WrapTemplate shape = make_template(heads.topology(), 10 * head.positions, {});
  const Part* eye = nullptr;
  for (const Part& part : shape.parts.parts) eye = part.is_eyeball ? &part : eye;
  ASSERT_NE(eye, nullptr);
  const Eigen::Vector3d centre = shape.parts.shapes[eye->ball_component].centre / 10;
  // A strip of the skin above the eye, a third of a millimetre off it.
  Scan dressed = head;
  std::vector<Triangle> strip;
  for (const Triangle& t : shape.skin.triangles) {
    const Eigen::Vector3d at = row3(head.positions, shape.skin.vertices[t[0]]) - centre;
    if (std::abs(at.x()) > 1.2 || at.y() < 0.4 || at.y() > 1.4 || at.z() < 0) continue;
    strip.push_back(
        {shape.skin.vertices[t[0]], shape.skin.vertices[t[1]], shape.skin.vertices[t[2]]});
  }
  ASSERT_GT(strip.size(), 8U);
  const auto rows = head.positions.rows();
  dressed.positions.resize(2 * rows, 3);
  dressed.positions << head.positions, head.positions.rowwise() + Eigen::RowVector3d(0, 0, 0.03);
  for (Triangle t : strip) {
    for (std::uint32_t& v : t) v += static_cast<std::uint32_t>(rows);
    dressed.triangles.push_back(t);
  }
  EXPECT_EQ(remove_covering_layers(dressed).triangles, head.triangles);
  std::erase_if(dressed.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(shape.parts.parts, [&](const Part& part) {
      return part.is_eyeball && std::ranges::binary_search(part.vertices, t[0]);
    });
  });
  EXPECT_EQ(remove_covering_layers(dressed).triangles, dressed.triangles) << "a scan in pieces";
}

TEST(ScanFile, GlbNodesStandWhereTheirParentsPutThem) {
  const Scan turned = parse_glb(
      glb(cube(), R"({"children":[1],"translation":[1,2,3],"scale":[2,2,2]})"), "scan.glb");
  const Positions expected = cube_positions(2).rowwise() + Eigen::RowVector3d(1, 2, 3);
  EXPECT_LT((turned.positions - expected).cwiseAbs().maxCoeff(), 1e-6);
  // A node that mirrors leaves the outside outside.
  const Scan mirrored = parse_glb(glb(cube(), R"({"children":[1],"scale":[-1,1,1]})"), "scan.glb");
  const Positions normals = vertex_normals_or_zero(mirrored.triangles, mirrored.positions);
  for (Index v = 0; v < 8; ++v) EXPECT_GT(normals.row(v).dot(mirrored.positions.row(v)), 0);
}

TEST(ScanFile, DamagedFilesAreRefusedByName) {
  const TemporaryFolder folder;
  const auto refuse = [&](const char* name, const std::string& bytes, const char* phrase) {
    SCOPED_TRACE(name);
    const auto path = folder.write(name, bytes);
    expect_error(ExitCode::kBadData, {name, phrase}, [&] { read_scan(path); });
  };
  const std::string ply = encode_scan(cube()), stl = binary_stl(cube()),
                    whole = glb(cube(), R"({"children":[1]})");
  refuse("cut.ply", ply.substr(0, ply.size() - 1), "ends too soon");
  refuse("none.ply", "ply\n", "header has no end");
  refuse("other.ply", "hello\n", "does not begin with ply");
  std::string far = ply;
  far[far.size() - 1] = 1;  // the last corner becomes 16,777,2xx
  refuse("far.ply", far, "refers to vertex");
  refuse("many.ply", "ply\nformat ascii 1.0\nelement vertex 99999999\nend_header\n", "claims");
  refuse("cut.stl", stl.substr(0, stl.size() - 1), "claims 12 triangles");
  refuse("word.stl", "solid x\nvertex 1 2 three\n", "three");
  refuse("cut.glb", whole.substr(0, whole.size() - 4), "cut off");
  refuse("loop.glb", glb(cube(), R"({"children":[0]})"), "form a cycle");
  for (const char* list : {R"("matrix":[1])", R"("translation":[0,0])", R"("rotation":[0,0,1])",
                           R"("scale":[1,1])", R"("scale":[1,1,1,1])"}) {
    refuse("list.glb", glb(cube(), concat(R"({"children":[1],)", list, "}")), "numbers in the");
  }
  refuse("child.glb", glb(cube(), R"({"children":[1,7]})"), "does not have");
  refuse("other_end.ply", "ply\nformat binary_middle_endian 1.0\nend_header\n", "middle");
  const std::string nan("\0\0\xc0\x7f", 4);
  refuse("nan.ply",
         "ply\nformat binary_little_endian 1.0\nelement face 1\n"
         "property list float int vertex_index\nend_header\n" +
             nan,
         "a list has nan entries");
  const auto ply_of = [](double x) {
    return concat("ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n",
                  "property double y\nproperty double z\nelement face 1\n",
                  "property list uchar int vertex_index\nend_header\n0 0 0\n", x,
                  " 0 0\n0 1 0\n3 0 1 2\n");
  };
  refuse("beyond.ply", ply_of(1e30), "not farther than 1e+09");
  refuse("flat.ply", ply_of(0), "triangles without area");
  refuse("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "face");
  refuse("scan.xyz", "1 2 3\n", ".glb");
  for (std::size_t cut = 0; cut < whole.size(); cut += 13) {
    EXPECT_THROW(parse_glb(whole.substr(0, cut), "cut.glb"), InvalidInput) << cut;
  }
  for (std::size_t cut = 0; cut < ply.size(); cut += 7) {
    EXPECT_THROW(parse_ply(ply.substr(0, cut), "cut.ply"), InvalidInput) << cut;
  }
}

// Its slivers lie in each other's boxes: wrapping it took minutes.
TEST(ScanFile, AFanIsNoSurfaceButACapMayBeOne) {
  const auto fan = [](std::size_t triangles) {
    Scan scan;
    const auto rim = static_cast<Index>(triangles) + 1;
    scan.positions.resize(rim + 1, 3);
    scan.positions.row(0) << 1, 2, 3;
    for (Index i = 0; i < rim; ++i) {
      const double angle = static_cast<double>(i) / static_cast<double>(rim);
      scan.positions.row(i + 1) << 1 + std::cos(angle), 2 + std::sin(angle), 4;
    }
    for (std::uint32_t t = 0; t < triangles; ++t) scan.triangles.push_back({0, t + 1, t + 2});
    return scan;
  };
  const TemporaryFolder folder;
  const auto path = folder.write("fan.ply", encode_scan(fan(5000)));
  expect_error(ExitCode::kBadData,
               {path.string(), "5000 of its 5000 triangles at one vertex, at (1, 2, 3)"},
               [&] { read_scan(path); });
  Scan with_cap = fan(5000);
  const Scan strip = fan(4000);
  for (int part = 0; part < 2; ++part) {  // each has less than half
    Positions positions(with_cap.positions.rows() + strip.positions.rows(), 3);
    positions << with_cap.positions, strip.positions.array() + 5 * (part + 1);
    const auto offset = static_cast<std::uint32_t>(with_cap.positions.rows());
    with_cap.positions = positions;
    for (const auto& [a, b, c] : strip.triangles) {
      with_cap.triangles.push_back({a + offset, b + offset, c + offset});
    }
  }
  EXPECT_EQ(read_scan(folder.write("cap.ply", encode_scan(with_cap))).triangles.size(), 13000U);
}

// Half a megabyte became gigabytes.
TEST(ScanFile, GlbPrimitivesThatNameTheSameDataTakeNoMoreThanTheFile) {
  const std::string one = R"({"attributes":{"POSITION":0},"indices":1})";
  const auto glb_of = [&](std::size_t times) {
    std::string json = one;
    for (std::size_t i = 1; i < times; ++i) json += ',' + one;
    std::string bytes = glb(cube(), R"({"children":[1]})");
    bytes.replace(bytes.find(one), one.size(), json);
    const auto grown = static_cast<std::uint32_t>(json.size() - one.size());
    for (const std::size_t at : {8U, 12U}) {
      std::uint32_t size = 0;
      std::memcpy(&size, bytes.data() + at, 4);
      size += grown;
      std::memcpy(bytes.data() + at, &size, 4);
    }
    return bytes;
  };
  const Scan scan = parse_glb(glb_of(2), "scan.glb");
  EXPECT_EQ(scan.positions.rows(), 8);
  EXPECT_EQ(scan.triangles.size(), 24U);
  expect_error(ExitCode::kBadData, {"scan.glb", "more numbers than its buffers have bytes"},
               [&] { parse_glb(glb_of(65'000), "scan.glb"); });
}

// Many elements of many members each that hold nothing would be counted through for hours.
TEST(ScanFile, PlyElementsThatHoldNothingTakeNoTime) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\n";
  for (int i = 0; i < 100'000; ++i) ply += "element nothing 1000000\n";
  EXPECT_EQ(parse_ply(ply + "end_header\n", "empty.ply").topology.face_count(), 0);
}

TEST(ScanFile, CoordinatesOfAMapInSinglePrecisionAreRefused) {
  const TemporaryFolder folder;
  Scan scan = cube();
  scan.positions.array() += 5334568;
  expect_error(ExitCode::kBadData, {"map.ply", "single precision", "near the origin"},
               [&] { read_scan(folder.write("map.ply", encode_scan(scan))); });
}

// The message blamed the landmarks.
TEST(ScanFile, CoordinatesWithFewDigitsAreRefused) {
  const TemporaryFolder folder;
  // A bowl of 30 by 30 vertices, about 0.2 units wide.
  const auto read = [&](double from_origin, double step) {
    std::string text;
    const auto rounded = [&](double x) { return step * std::round((x + from_origin) / step); };
    for (int i = 0; i < 900; ++i) {
      const double x = 0.007 * (i % 30) + 1e-5 * i, y = 0.007 * (i / 30) - 1e-5 * i;
      text += "v";
      for (const double c : {x, y, x * x + y * y}) {
        char number[40];
        std::snprintf(number, sizeof number, " %.9f", rounded(c));
        text += number;
      }
      text += '\n';
    }
    for (int i = 0; i < 869; ++i) {
      if (i % 30 != 29) text += concat("f ", i + 1, ' ', i + 2, ' ', i + 31, '\n');
    }
    read_scan(folder.write("scan.obj", text));
  };
  EXPECT_NO_THROW(read(0, 1e-4));
  EXPECT_NO_THROW(read(5e6, 1e-4));
  expect_error(ExitCode::kBadData,
               {"scan.obj", "x coordinates near 5000000 have steps of 0.010", "near the origin"},
               [&] { read(5e6, 0.01); });
}

TEST(ScanFile, VerticesWithoutAPlaceTakeTheirTrianglesAlong) {
  const TemporaryFolder folder;
  Scan scan = cube();
  scan.positions(0, 1) = std::nan("");
  const Scan read = read_scan(folder.write("nan.ply", encode_scan(scan)));
  EXPECT_TRUE(read.positions.allFinite());
  EXPECT_LT(read.triangles.size(), 12U);
  EXPECT_GT(read.triangles.size(), 5U);
}

TEST(ScanFile, SmallPiecesAreLeftOut) {
  Scan scan = cube();
  scan.positions.conservativeResize(11, 3);
  scan.positions.bottomRows(3) << 5, 0, 0, 5.01, 0, 0, 5, 0.01, 0;
  scan.triangles.push_back({8, 9, 10});
  EXPECT_EQ(remove_small_pieces(scan, 0.001).triangles.size(), 12U);
  EXPECT_EQ(remove_small_pieces(scan, 0).triangles.size(), 13U);
}

}  // namespace
}  // namespace crowdface::testing
