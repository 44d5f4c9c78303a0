// SPDX-License-Identifier: Apache-2.0
// Heads whose exports split, joined or reordered vertices take one mesh.
#include "crowdface/heads/common_mesh.h"

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/head_checks.h"
#include "crowdface/mesh/all_columns.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using testing::SmallCrowd;
using testing::SmallCrowdFolder;

/// Number of a vertex in a changed file, from its vertex, its polygon and its position in the
/// polygon.
using Copy = std::function<std::string(std::uint32_t vertex, Index face)>;

std::string whole(std::uint32_t vertex, Index) {
  return concat(vertex);
}
std::string split_below_face_100(std::uint32_t vertex, Index face) {
  return concat(vertex, face < 100 ? "a" : "b");
}
std::string split_below_face_200(std::uint32_t vertex, Index face) {
  return concat(vertex, face < 200 ? "a" : "b");
}
std::string split_all(std::uint32_t vertex, Index face) {
  return concat(vertex, '/', face);
}

class CommonMesh : public ::testing::Test {
 protected:
  CommonMesh() {
    for (const std::string& name : folder_.names()) {
      original_.push_back(read_obj(folder_.head(name)));
    }
    const auto& used = original_[0].topology.corner_vertices;
    used_ = std::ssize(std::set(used.begin(), used.end()));
  }
  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.heads = 3;
    crowd.bowl.columns = crowd.bowl.rows = 20;
    return crowd;
  }

  /// The corner that all triangles of a quad share, from the polygon's number.
  using FanCorner = std::function<std::size_t(Index face)>;

  /// Writes a head with a vertex for each result of `copy`, and polygons in this order or the
  /// reverse order, whole or as triangles.
  void write(
      std::size_t head, const Copy& copy, bool reverse = false, bool triangles = false,
      const FanCorner& fan_corner = [](Index) { return 0; }) {
    const ObjFile& file = original_[head];
    std::map<std::string, std::size_t> numbers;
    std::string vertices, uvs, faces;
    for (Index t = 0; t < file.uvs.rows(); ++t) {
      uvs += concat("vt ", file.uvs(t, 0), ' ', file.uvs(t, 1), '\n');
    }
    const Index count = file.topology.face_count();
    for (Index i = 0; i < count; ++i) {
      const Index f = reverse ? count - 1 - i : i;
      std::vector<std::string> corners;
      for (std::size_t c = 0; c < file.topology.face(f).size(); ++c) {
        const std::uint32_t v = file.topology.face(f)[c];
        const auto [number, is_new] = numbers.try_emplace(copy(v, f), numbers.size() + 1);
        if (is_new) {
          vertices += concat("v ", file.positions(v, 0), ' ', file.positions(v, 1), ' ',
                             file.positions(v, 2), '\n');
        }
        corners.push_back(concat(number->second, '/', file.topology.face_uvs(f)[c] + 1));
      }
      if (!triangles) faces += concat("f ", join(corners, " "), '\n');
      if (corners.size() == 4) {
        const auto first = corners.begin() + static_cast<std::ptrdiff_t>(fan_corner(f));
        std::rotate(corners.begin(), first, corners.end());
      }
      for (std::size_t c = 1; triangles && c + 1 < corners.size(); ++c) {
        faces += concat("f ", corners[0], ' ', corners[c], ' ', corners[c + 1], '\n');
      }
    }
    folder_.folder().write("heads/" + folder_.names()[head] + ".obj", vertices + uvs + faces);
  }

  std::vector<HeadFile> read() const {
    std::vector<std::filesystem::path> paths;
    for (const std::string& name : folder_.names()) paths.push_back(folder_.head(name));
    Problems problems;
    std::vector<HeadFile> heads = read_heads(paths, {}, problems);
    compare_meshes(heads, problems);
    problems.throw_if_any();
    return heads;
  }

  /// Expects heads with as many vertices, whose polygons lie where those of the originals lie.
  void expect_common_mesh(Index vertices) const {
    const std::vector<HeadFile> heads = read();
    ASSERT_EQ(heads.size(), original_.size());
    for (std::size_t h = 0; h < heads.size(); ++h) {
      SCOPED_TRACE(h);
      EXPECT_EQ(heads[h].mesh, heads[0].mesh);
      const Topology &expected = original_[h].topology, &found = heads[h].mesh->topology;
      EXPECT_EQ(found.vertex_count, vertices);
      ASSERT_EQ(found.face_offsets, expected.face_offsets);
      EXPECT_LT((original_[h].positions(expected.corner_vertices, kAllColumns) -
                 heads[h].file.positions(found.corner_vertices, kAllColumns))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-6);
    }
  }

  SmallCrowdFolder folder_{crowd()};
  std::vector<ObjFile> original_;
  Index used_ = 0;  ///< number of vertices with polygons
};

TEST_F(CommonMesh, JoinsSplitVerticesOfAnyHead) {
  for (std::size_t split = 0; split < 3; ++split) {
    for (std::size_t h = 0; h < 3; ++h) write(h, h == split ? split_below_face_100 : whole);
    expect_common_mesh(used_);
    for (std::size_t h = 0; h < 3; ++h) write(h, h == split ? split_all : whole);
    expect_common_mesh(used_);
  }
}

TEST_F(CommonMesh, JoinsVerticesThatAllHeadsSplitInOtherPlaces) {
  write(0, split_below_face_100);
  write(1, split_below_face_200);
  write(2, split_below_face_200);
  expect_common_mesh(used_);
}

TEST_F(CommonMesh, JoinsSplitVerticesInAnotherOrder) {
  write(0, whole);
  write(1, split_below_face_100, true);
  write(2, split_below_face_100, false, true);
  expect_common_mesh(used_);
}

// Programs cut a quad along its shorter diagonal, which differs from head to head.
TEST_F(CommonMesh, DoesNotDependOnTheDiagonals) {
  const FanCorner mixed = [](Index f) { return static_cast<std::size_t>(f % 3 == 0 ? 1 : 0); };
  write(0, whole);
  write(1, whole, false, true, mixed);
  write(2, whole);
  expect_common_mesh(used_);
  for (std::size_t h = 0; h < 3; ++h) {
    write(h, whole, false, true, [h](Index f) { return static_cast<std::size_t>(f) % 7 == h; });
  }
  const std::vector<HeadFile> heads = read();
  for (std::size_t h = 0; h < 3; ++h) {
    EXPECT_EQ(heads[h].mesh, heads[0].mesh);
    EXPECT_EQ(heads[h].file.positions.rows(), used_);
  }
}

// All other heads were blamed.
TEST_F(CommonMesh, BlamesTheOddHeadAlsoIfItIsTheFirst) {
  folder_.folder().write("heads/" + folder_.names()[0] + ".obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write(1, whole);
  write(2, whole);
  try {
    read();
    FAIL() << "expected a refusal";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, ::testing::HasSubstr(folder_.names()[0] + ".obj: not the same mesh as"));
    EXPECT_EQ(message.find(folder_.names()[2]), message.npos) << message;
  }
}

TEST_F(CommonMesh, HasTheOrderOfMostHeads) {
  write(0, whole, true);
  write(1, whole);
  write(2, whole);
  const std::vector<HeadFile> heads = read();
  EXPECT_EQ(heads[0].mesh, heads[1].mesh);
  const ObjFile usual = read_obj(folder_.head(folder_.names()[1]));
  EXPECT_EQ(heads[1].file.positions, usual.positions);
}

// Without texture coordinates, polygons that are cut at random in another order are not matched.
TEST_F(CommonMesh, TellsThatAHeadIsReorderedAndCut) {
  for (ObjFile& file : original_) file.uvs.setZero();
  write(0, whole);
  write(1, whole, true, true, [](Index f) { return static_cast<std::size_t>(f * f % 7 % 2); });
  write(2, whole);
  testing::expect_error(
      ExitCode::kBadData,
      {folder_.names()[1], "cut into triangles, and its vertices are in another order"},
      [&] { read(); });
}

TEST_F(CommonMesh, DoesNotDependOnOrderAndDiagonals) {
  const FanCorner mixed = [](Index f) { return static_cast<std::size_t>(f % 3 == 0 ? 1 : 0); };
  for (const Copy& copy : {Copy(whole), Copy(split_below_face_100)}) {
    write(0, whole);
    write(1, copy, true, true, mixed);
    write(2, whole);
    expect_common_mesh(used_);
  }
}

// Blender cuts most quads of GLB heads alike; the others tore the mesh.
TEST_F(CommonMesh, IsNotTornWhereDiagonalsDiffer) {
  std::vector<HeadFile> heads(2);
  for (std::size_t h = 0; h < 2; ++h) {
    write(h, whole, false, true, [h](Index f) { return f < 3 ? h : 0; });
    HeadFile& head = heads[h];
    head.file = read_obj(folder_.head(folder_.names()[h]));
    head.mesh = std::make_shared<HeadMesh>(
        HeadMesh{head.file.topology, head.file.uvs, head.file.corner_normals});
    head.mesh_digest = head.mesh->digest();
    head.has_joined_vertices = true;
  }
  convert_to_common_mesh(heads);
  EXPECT_EQ(heads[1].mesh, heads[0].mesh);
  EXPECT_EQ(heads[0].mesh->topology.vertex_count, used_);
  EXPECT_EQ(heads[1].file.positions.rows(), used_);
}

TEST_F(CommonMesh, IsNotThatOfAMirroredHead) {
  std::istringstream lines(testing::read_text(folder_.head(folder_.names()[1])));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "v") words[1] = concat(-*parse_double(words[1]));
    if (words[0] == "f") std::reverse(words.begin() + 1, words.end());
    text += join(words, " ") + '\n';
  }
  folder_.folder().write("heads/" + folder_.names()[1] + ".obj", text);
  testing::expect_error(ExitCode::kBadData, {folder_.names()[1], "is mirrored"}, [&] { read(); });
}

TEST(FewDecimals, AreToldIfTheySpoilTheSurface) {
  const auto warnings = [](double step, double mm, double offset) {
    std::vector<HeadFile> heads(1);
    Positions& positions = heads[0].file.positions;
    positions = 100 * Positions::Random(1000, 3);
    if (step > 0) positions = (positions / step).array().round() * step;
    positions.array() += offset;
    positions = positions.cast<float>().cast<double>();
    return few_decimals_warnings(heads, mm);
  };
  EXPECT_THAT(warnings(1, 1, 0), ::testing::ElementsAre(::testing::HasSubstr("to 1 mm")));
  EXPECT_THAT(warnings(0.1, 10, 0), ::testing::ElementsAre(::testing::HasSubstr("to 1 mm")));
  EXPECT_TRUE(warnings(0.01, 10, 0).empty());
  EXPECT_TRUE(warnings(0.01, 1, 5).empty());
  EXPECT_TRUE(warnings(0, 1, 0).empty());
  EXPECT_TRUE(warnings(0, 1000, 0).empty());
}

TEST_F(CommonMesh, HasThePolygonsOfMostHeads) {
  for (const bool split : {false, true}) {
    write(0, split ? split_below_face_100 : whole, false, true);
    write(1, whole);
    write(2, whole);
    expect_common_mesh(used_);
  }
}

TEST_F(CommonMesh, HasTextureCoordinatesIfAnyHeadHasThem) {
  for (std::size_t h = 0; h < 3; ++h) write(h, whole);
  for (const std::size_t bare : {0U, 2U}) {
    const std::string text = read_file(folder_.head(folder_.names()[bare]));
    folder_.folder().write(
        "heads/" + folder_.names()[bare] + ".obj",
        std::regex_replace(text, std::regex("vt [^\n]*\n|/[0-9]+"), std::string()));
    const std::vector<HeadFile> heads = read();
    for (const HeadFile& head : heads) {
      EXPECT_EQ(head.mesh, heads[1].mesh);
      EXPECT_GT(head.mesh->uvs.rows(), 0);
    }
    write(bare, whole);
  }
}

TEST_F(CommonMesh, KeepsVerticesThatAllHeadsSplitAlike) {
  for (std::size_t h = 0; h < 3; ++h) write(h, split_below_face_100);
  EXPECT_GT(read()[0].mesh->topology.vertex_count, used_);
}

TEST_F(CommonMesh, ReportsOtherTextureCoordinatesOfSplitHeads) {
  for (std::size_t h = 0; h < 3; ++h) {
    write(h, h == 1 ? split_below_face_100 : whole);
    original_[0].uvs(7, 0) += 0.5;
    write(0, whole);
  }
  try {
    read();
    FAIL() << "expected a refusal";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("expected the texture coordinate"), std::string::npos)
        << error.what();
  }
}

TEST_F(CommonMesh, MatchesCornersOnlyAtOnePosition) {
  const Topology& topology = original_[0].topology;
  Positions positions = original_[0].positions;
  Topology split = topology;
  split.corner_vertices[5] = static_cast<std::uint32_t>(split.vertex_count++);
  positions.conservativeResize(split.vertex_count, 3);
  positions.row(split.vertex_count - 1) = positions.row(topology.corner_vertices[5]);
  const auto vertices = match_vertices_by_corners(topology, split, positions);
  ASSERT_TRUE(vertices);
  EXPECT_EQ(std::ssize(*vertices), topology.vertex_count);
  positions(split.vertex_count - 1, 0) += 0.01;
  EXPECT_FALSE(match_vertices_by_corners(topology, split, positions));
  EXPECT_TRUE(match_vertices_by_corners(split, topology, original_[0].positions))
      << "the copies take the position of the vertex";
}

}  // namespace
}  // namespace crowdface
