// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_template.h"

#include <charconv>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::TemporaryFolder;

std::string shortest(double value) {
  char buffer[40];
  const float single = static_cast<float>(value);
  return single == 0 ? "0" : std::string(buffer, std::to_chars(buffer, buffer + 40, single).ptr);
}

/// A line with the first three numbers after its keyword replaced.
std::string with_numbers(const std::string& line, const Eigen::RowVector3d& row) {
  std::string out;
  std::size_t at = 0;
  for (int token = 0; token < 4; ++token) {
    const std::size_t begin = line.find_first_not_of(" \t", at);
    const std::size_t end = std::min(line.find_first_of(" \t\r\n", begin), line.size());
    out += line.substr(at, begin - at);
    out += token == 0 ? line.substr(begin, end - begin) : shortest(row(token - 1));
    at = end;
  }
  return out + line.substr(at);
}

/// The form filled in line by line, as slow and plain as can be.
std::string filled_in(const ObjFile& file, const Topology& topology, const Positions& positions) {
  const std::string text(file.file.bytes());
  Index normal_count = 0;
  for (std::size_t at = 0; (at = text.find("\nvn", at)) != text.npos; ++at) ++normal_count;
  Positions normals = Positions::Zero(normal_count, 3);
  for (Index f = 0; f < topology.face_count() && !file.corner_normals.empty(); ++f) {
    const Eigen::RowVector3d area = face_area_vector(topology, f, positions);
    for (auto c = topology.face_offsets[static_cast<std::size_t>(f)];
         c < topology.face_offsets[static_cast<std::size_t>(f) + 1]; ++c) {
      if (file.corner_normals[c] != kNoIndex) normals.row(file.corner_normals[c]) += area;
    }
  }
  std::string out;
  Index v = 0, n = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.starts_with("v ") || line.starts_with("v\t")) {
      out += with_numbers(line, positions.row(v++));
    } else if (line.starts_with("vn ") || line.starts_with("vn\t")) {
      const Eigen::RowVector3d sum = normals.row(n++);
      const double length = std::sqrt(sum(0) * sum(0) + sum(1) * sum(1) + sum(2) * sum(2));
      out += length > 0 ? with_numbers(line, sum / length) : line;
    } else {
      out += line;
    }
    at = end;
  }
  return out;
}

/// A grid's OBJ file whose lines `vertex_lines` writes.
std::string grid_text(
    const Topology& grid,
    const std::function<void(std::string&, Index, const Eigen::RowVector3d&)>& vertex_lines,
    bool with_normals) {
  const Positions positions = 10 * testing::random_positions(grid.vertex_count, 1);
  std::string text = "# head\nmtllib a.mtl\no grid\n";
  for (Index i = 0; i < grid.vertex_count; ++i) vertex_lines(text, i, positions.row(i));
  text += "usemtl skin\n";
  for (Index f = 0; f < grid.face_count(); ++f) {
    text += 'f';
    for (const std::uint32_t v : grid.face(f)) {
      text += with_normals ? concat(' ', v + 1, "//", v + 1) : concat(' ', v + 1);
    }
    text += '\n';
  }
  return text;
}

void append_line(std::string& text, const std::string& start, const Eigen::RowVector3d& row,
                 const std::string& end = "\n") {
  text += concat(start, format_fixed(row(0), 4), ' ', format_fixed(row(1), 4), ' ',
                 format_fixed(row(2), 4), end);
}

/// Larger than several blocks, in different layouts.
struct Layout {
  const char* name;
  bool normals;
  std::function<void(std::string&, Index, const Eigen::RowVector3d&)> lines;
};

class ObjLayouts : public ::testing::TestWithParam<Layout> {};

TEST_P(ObjLayouts, AreFilledInLineByLine) {
  const Topology grid = testing::grid_topology(180, 140);
  const TemporaryFolder folder;
  const ObjFile file =
      read_obj(folder.write("grid.obj", grid_text(grid, GetParam().lines, GetParam().normals)));
  ASSERT_EQ(file.corner_normals.empty(), !GetParam().normals);
  const ObjTemplate form(file, file.topology);
  for (const std::uint64_t seed : {2U, 3U}) {
    Positions positions = 20 * testing::random_positions(grid.vertex_count, seed);
    positions.row(5).setZero();
    positions.row(6) << -1.17549435e-38, 3.40282347e+38, -0.0;  // as long as numbers get
    const std::string expected = filled_in(file, file.topology, positions);
    for (const int threads : {1, 2, 5}) {
      const ThreadLimit limit(threads);
      const EncodedFile encoded = form.encode(positions, "grid");
      ASSERT_TRUE(encoded.text() == expected) << threads << " threads";
      EXPECT_EQ(encoded.size(), expected.size());
      EXPECT_EQ(encoded.digest(), hash_bytes(expected));
      EXPECT_LE(encoded.size(), form.encoding_memory_bytes() + file.file.bytes().size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ObjLayouts,
    ::testing::Values(Layout{"vertices", false,
                             [](std::string& text, Index, const Eigen::RowVector3d& row) {
                               append_line(text, "v ", row);
                             }},
                      Layout{"carriage_returns_and_tabs", false,
                             [](std::string& text, Index, const Eigen::RowVector3d& row) {
                               append_line(text, "v\t", row, "\r\n");
                             }},
                      Layout{"comments_between", false,
                             [](std::string& text, Index i, const Eigen::RowVector3d& row) {
                               if (i % 9000 == 8999) text += "# so far so good\n\ng more\n";
                               append_line(text, "v ", row);
                             }},
                      Layout{"colours", false,
                             [](std::string& text, Index i, const Eigen::RowVector3d& row) {
                               append_line(text, "v  ", row, concat(" 0.5 ", i % 7, " 1\n"));
                             }},
                      Layout{"interleaved_normals", true,
                             [](std::string& text, Index, const Eigen::RowVector3d& row) {
                               append_line(text, "v ", row);
                               append_line(text, "vn ", row.normalized());
                             }},
                      Layout{"normals_that_nothing_uses", false,
                             [](std::string& text, Index, const Eigen::RowVector3d& row) {
                               append_line(text, "v ", row);
                               append_line(text, "vn ", row.normalized());
                             }}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(ObjTemplate, KeepsNormalsThatNoFaceUsesAmongThoseInUse) {
  const Topology grid = testing::grid_topology(120, 90);
  std::string text;
  for (Index i = 0; i < grid.vertex_count; ++i) text += concat("v ", i, " 0 0\n");
  // The first and every third of the others is used by no face.
  for (Index i = 0; i < 3 * grid.vertex_count + 1; ++i) text += concat("vn 0.0 ", i, ".50 -0\n");
  for (Index f = 0; f < grid.face_count(); ++f) {
    text += 'f';
    for (const std::uint32_t v : grid.face(f)) text += concat(' ', v + 1, "//", 3 * v + 2);
    text += '\n';
  }
  const TemporaryFolder folder;
  const ObjFile file = read_obj(folder.write("grid.obj", text));
  const Positions positions = testing::random_positions(grid.vertex_count, 4);
  const ObjTemplate form(file, file.topology);
  EXPECT_TRUE(form.encode(positions, "grid").text() == filled_in(file, grid, positions));
  // Of a mesh without area no normal is known.
  const Positions nowhere = Positions::Zero(grid.vertex_count, 3);
  EXPECT_TRUE(form.encode(nowhere, "grid").text() == filled_in(file, grid, nowhere));
}

TEST(ObjTemplate, KeepsSixteenBytesOfALine) {
  const Topology grid = testing::grid_topology(180, 140);
  const TemporaryFolder folder;
  const auto lines = [](std::string& out, Index, const Eigen::RowVector3d& row) {
    append_line(out, "v ", row);
  };
  const ObjFile file = read_obj(folder.write("grid.obj", grid_text(grid, lines, false)));
  const ObjTemplate form(file, file.topology);
  EXPECT_LT(form.memory_bytes(), 17 * static_cast<std::size_t>(grid.vertex_count));
}

// What the cache says of a text may be forged: positions would be read past their end.
TEST(ObjTemplate, RefusesATextOfOtherRowsThanItsMesh) {
  const TemporaryFolder folder;
  ObjFile file =
      read_obj(folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n"));
  const Topology topology = file.topology;
  file.corner_normals[1] = 1;
  testing::expect_error(ExitCode::kBadData, {"t.obj", "found 3 and 1"},
                        [&] { ObjTemplate(file, topology); });
  file.corner_normals[1] = 0;
  Topology fewer = topology;
  fewer.vertex_count = 2;
  testing::expect_error(ExitCode::kBadData, {"t.obj", "expected 2 vertices"},
                        [&] { ObjTemplate(file, fewer); });
  EXPECT_NO_THROW(ObjTemplate(file, topology));
}

TEST(ObjTemplate, RefusesWhatSinglePrecisionCannotHold) {
  const TemporaryFolder folder;
  const ObjFile file = read_obj(folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  const ObjTemplate form(file, file.topology);
  Positions positions = file.positions;
  positions(1, 1) = 1e39;
  testing::expect_error(ExitCode::kBadData, {"face_7", "not finite"},
                        [&] { form.encode(positions, "face_7"); });
}

}  // namespace
}  // namespace crowdface
