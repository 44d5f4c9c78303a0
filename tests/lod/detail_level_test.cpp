// SPDX-License-Identifier: Apache-2.0
#include "crowdface/lod/detail_level.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "crowdface/lod/level_error.h"
#include "crowdface/mesh/vector3.h"
#include "head_models/synth/synthetic_head.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kColumns = 40, kRows = 30;

/// A flat sheet, one unit a quad, with a hole; its texture is torn along a column, where the right
/// part lies five units higher.
HeadSet sheet() {
  const auto in_hole = [](std::uint32_t x, std::uint32_t y) {
    return x >= 5 && x < 12 && y >= 8 && y < 14;
  };
  constexpr std::uint32_t kTear = 22, kStride = kColumns + 1;
  HeadSet set;
  const std::uint32_t vertices = kStride * (kRows + 1);
  set.topology.vertex_count = vertices;
  set.uvs.resize(2 * vertices, 2);
  Positions positions(vertices, 3);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const double x = v % kStride, y = v / kStride;
    positions.row(v) = Eigen::RowVector3d(x, y, 0);
    set.uvs.row(v) = Eigen::RowVector2d(x / 100, y / 100);
    set.uvs.row(v + vertices) = Eigen::RowVector2d(x / 100, (y + 5) / 100);
  }
  for (std::uint32_t y = 0; y < kRows; ++y) {
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      if (in_hole(x, y)) continue;
      const std::uint32_t a = y * kStride + x;
      const std::array<std::uint32_t, 4> face = {a, a + 1, a + kStride + 1, a + kStride};
      std::array<std::uint32_t, 4> uvs = face;
      if (x >= kTear) {
        for (std::uint32_t& uv : uvs) uv += vertices;
      }
      set.topology.add_face(face, uvs);
    }
  }
  set.heads.push_back({"sheet", positions});
  return set;
}

/// The faces right of and above a step are of look 1.
std::vector<std::uint32_t> looks_of(const HeadSet& set) {
  std::vector<std::uint32_t> looks;
  for (Index f = 0; f < set.topology.face_count(); ++f) {
    const auto first = set.heads[0].positions.row(set.topology.face(f)[0]);
    looks.push_back(first.x() >= 15 && first.y() >= (first.x() < 30 ? 10 : 20) ? 1 : 0);
  }
  return looks;
}

TEST(DetailLevels, KeepRimsSeamsAndBordersOfLooks) {
  const HeadSet set = sheet();
  const auto looks = looks_of(set);
  std::map<std::uint32_t, double> whole;
  for (const std::uint32_t look : looks) whole[look] += 1;
  const std::array<double, 2> shares = {0.4, 0.1};
  for (const DetailLevel& level : detail_levels(set, looks, shares)) {
    const Positions positions = level.restrict_rows(set.heads[0].positions);
    std::map<std::uint32_t, double> area;
    for (Index t = 0; t < level.topology.face_count(); ++t) {
      const auto corners = level.topology.face(t);
      const auto uvs = level.topology.face_uvs(t);
      const Eigen::Vector3d a = row3(positions, corners[1]) - row3(positions, corners[0]);
      const Eigen::Vector3d b = row3(positions, corners[2]) - row3(positions, corners[0]);
      const double twice = a.x() * b.y() - a.y() * b.x();
      EXPECT_GE(twice, 0) << "turned over";
      area[looks[level.source_faces[static_cast<std::size_t>(t)]]] += twice / 2;
      const Eigen::RowVector2d u = level.uvs.row(uvs[1]) - level.uvs.row(uvs[0]);
      const Eigen::RowVector2d v = level.uvs.row(uvs[2]) - level.uvs.row(uvs[0]);
      EXPECT_NEAR(u.x(), a.x() / 100, 1e-12) << "reaches over the tear";
      EXPECT_NEAR(u.y(), a.y() / 100, 1e-12);
      EXPECT_NEAR(v.x(), b.x() / 100, 1e-12);
      EXPECT_NEAR(v.y(), b.y() / 100, 1e-12);
    }
    EXPECT_NEAR(area[0], whole[0], 1e-9);
    EXPECT_NEAR(area[1], whole[1], 1e-9);
    const double all = 2.0 * static_cast<double>(set.topology.face_count());
    EXPECT_LE(static_cast<double>(level.topology.face_count()), level.share * all + 1);
  }
}

TEST(DetailLevels, AreRowsOfTheWholeMesh) {
  const HeadSet set = sheet();
  const std::array<double, 1> shares = {0.25};
  const DetailLevel level = detail_levels(set, looks_of(set), shares).front();
  EXPECT_TRUE(std::is_sorted(level.vertices.begin(), level.vertices.end()));
  EXPECT_EQ(std::set(level.vertices.begin(), level.vertices.end()).size(), level.vertices.size());
  const auto& used = level.topology.corner_vertices;
  EXPECT_EQ(std::set(used.begin(), used.end()).size(), level.vertices.size());

  Displacements whole;
  for (std::uint32_t v = 3; v < 400; v += 3) whole.vertices.push_back(v);
  whole.moves = testing::random_positions(static_cast<Index>(whole.vertices.size()), 3);
  Positions moved = set.heads[0].positions;
  whole.add_to(moved);
  Positions some = level.restrict_rows(set.heads[0].positions);
  const Displacements of_level = level.restrict_rows(whole);
  EXPECT_FALSE(of_level.vertices.empty());
  EXPECT_LT(of_level.vertices.size(), whole.vertices.size());
  of_level.add_to(some);
  EXPECT_EQ(some, level.restrict_rows(moved));
}

HeadSet synthetic_heads() {
  const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  HeadSet set{synthetic.topology(), synthetic.uvs(), {}};
  for (const std::uint64_t i : {0, 1, 2}) {
    set.heads.push_back({"head" + std::to_string(i), synthetic.positions(5, i)});
  }
  return set;
}

double distance_to_level(const DetailLevel& level, const Positions& positions,
                         const Eigen::Vector3d& point) {
  double least = 1e300;
  for (Index t = 0; t < level.topology.face_count(); ++t) {
    const auto face = level.topology.face(t);
    const Eigen::Vector3d a = row3(positions, face[0]), b = row3(positions, face[1]),
                          c = row3(positions, face[2]);
    const auto shares = nearest_in_triangle(a, b, c, point);
    least = std::min(least, (shares[0] * a + shares[1] * b + shares[2] * c - point).norm());
  }
  return least;
}

TEST(LevelError, IsNotBelowTheDistanceToTheSurfaceNorFarAbove) {
  const HeadSet set = synthetic_heads();
  const std::vector<std::uint32_t> looks(static_cast<std::size_t>(set.topology.face_count()), 0);
  const std::array<double, 2> shares = {0.5, 0.1};
  double before = 0;
  for (const DetailLevel& level : detail_levels(set, looks, shares)) {
    const NearestLevelTriangles map =
        find_level_triangles(set.topology, build_adjacency(set.topology), level, mean_head(set));
    ASSERT_EQ(map.vertices.size() + level.vertices.size(),
              static_cast<std::size_t>(set.topology.vertex_count));
    double most = 0, squares = 0;
    std::vector<const Positions*> heads;
    for (const Head& head : set.heads) {
      heads.push_back(&head.positions);
      const Positions some = level.restrict_rows(head.positions);
      for (const std::uint32_t v : map.vertices) {
        const double distance = distance_to_level(level, some, row3(head.positions, v));
        most = std::max(most, distance);
        squares += distance * distance;
      }
    }
    const auto count = static_cast<double>(heads.size() * map.vertices.size());
    const double rms = std::sqrt(squares / count);
    const LevelError error = level_error(level, map, heads);
    EXPECT_GE(error.max, most);
    EXPECT_GE(error.root_mean_square, rms);
    EXPECT_LT(error.max, 2 * most);
    EXPECT_LT(error.root_mean_square, 1.2 * rms);
    EXPECT_GT(error.root_mean_square, before) << "fewer triangles are farther off";
    before = error.root_mean_square;
  }
}

TEST(DetailLevels, RefuseOtherSizes) {
  const HeadSet set = sheet();
  const std::array<double, 1> shares = {0.5};
  EXPECT_THROW(detail_levels(set, std::vector<std::uint32_t>(3), shares), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
