// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/skin_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/validity/intersections.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kColumns = 21, kRows = 31;
constexpr double kFoldedExtent = 200;

/// A sheet folded once, like closed lips: the lower half lies `gap` below the upper one.
Positions folded(double gap) {
  Positions positions(kColumns * kRows, 3);
  constexpr double kMiddle = (kRows - 1) / 2.0;
  for (std::uint32_t r = 0; r < kRows; ++r) {
    const double along = (r - kMiddle) / 2;
    const double height = gap / 2 * std::clamp(along, -1.0, 1.0);
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      positions.row(r * kColumns + c) << c / 2.0 + 0.1 * std::sin(r), height, std::abs(along);
    }
  }
  return positions;
}

Topology sheet() {
  Topology topology;
  topology.vertex_count = kColumns * kRows;
  topology.face_offsets = {0};
  for (std::uint32_t r = 0; r + 1 < kRows; ++r) {
    for (std::uint32_t c = 0; c + 1 < kColumns; ++c) {
      const std::uint32_t v = r * kColumns + c;
      for (const std::uint32_t corner : {v, v + 1, v + kColumns + 1, v + kColumns}) {
        topology.corner_vertices.push_back(corner);
      }
      topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
    }
  }
  return topology;
}

/// The upper half comes down around its middle, and the lower one up.
Displacements closing(const Positions& mesh, double depth, double of_lower) {
  Displacements shape;
  std::vector<double> by;
  for (std::uint32_t v = 0; v < mesh.rows(); ++v) {
    const double off = Eigen::Vector3d(mesh(v, 0) - 5, 0, mesh(v, 2) - 4).norm() / 3;
    const double share = v < mesh.rows() / 2 ? of_lower : of_lower - 1;
    if (share == 0 || off >= 1) continue;
    shape.vertices.push_back(v);
    by.push_back(share * depth * (1 - off * off) * (1 - off * off));
  }
  shape.moves.setZero(static_cast<Index>(by.size()), 3);
  for (std::size_t i = 0; i < by.size(); ++i) shape.moves(static_cast<Index>(i), 1) = by[i];
  return shape;
}

/// The upper half comes down alone.
Displacements pressed(const Positions& mesh, double depth) {
  return closing(mesh, depth, 0);
}

class SkinCrossingsTest : public ::testing::Test {
 protected:
  SkinCrossingsTest() : skin_(kColumns * kRows) {
    std::iota(skin_.begin(), skin_.end(), 0U);
    crossings_ = SkinCrossings(topology_, skin_, kFoldedExtent, {});
  }
  std::size_t pairs_in(const Positions& face, const Displacements& shape) const {
    Positions mesh = face;
    shape.add_to(mesh);
    const std::vector<Triangle> triangles = triangles_of(topology_);
    return intersecting_pairs(triangles, mesh, near_pairs(triangles, mesh, 0)).size();
  }
  Displacements mended(const Positions& face, const Displacements& shape,
                       const SkinCrossings::SearchedSkin& searched_skin) const {
    const std::array searches = {&searched_skin.search};
    const CrossingSearch all = crossings_.merge_searches(face, searches);
    const std::vector<bool> at_rest = crossings_.crossing_at_rest(face, all);
    const SkinCrossings::Face there{face, at_rest, {}};
    Displacements result = shape;
    Positions mesh = face;
    const Index left = crossings_.repair(there, searched_skin, mesh, result);
    EXPECT_EQ(mesh, face);
    EXPECT_EQ(crossings_.count_intersecting(there, searched_skin, result, mesh), left);
    EXPECT_EQ(mesh, face);
    return result;
  }

  Topology topology_ = sheet();
  std::vector<std::uint32_t> skin_;
  SkinCrossings crossings_;
};

TEST_F(SkinCrossingsTest, AreMendedWhereAFaceIsNarrower) {
  const Positions face = folded(0.6);
  const Displacements shape = pressed(folded(1), 0.9);
  const auto searched_skin = crossings_.find_searched_skin(folded(1), shape, {});
  ASSERT_EQ(pairs_in(folded(1), shape), 0U);
  ASSERT_GT(pairs_in(face, shape), 20U);
  const Displacements result = mended(face, shape, searched_skin);
  EXPECT_EQ(pairs_in(face, result), 0U);
  EXPECT_EQ(result.vertices, shape.vertices);
  EXPECT_LT(result.moves.col(1).minCoeff(), -0.3) << "the shape is left";
}

TEST_F(SkinCrossingsTest, AFoldOfFewEdgesIsFound) {
  Positions flat(kColumns * kRows, 3);
  for (std::uint32_t r = 0; r < kRows; ++r) {
    for (std::uint32_t c = 0; c < kColumns; ++c) flat.row(r * kColumns + c) << c, 0, r;
  }
  Displacements shape;
  for (std::uint32_t v = 14 * kColumns; v < 17 * kColumns; ++v) shape.vertices.push_back(v);
  shape.moves.setZero(static_cast<Index>(shape.vertices.size()), 3);
  // A row goes over the next one, and down through what lies behind that.
  for (Index i = 0; i < kColumns; ++i) shape.moves.row(i) << 0, 0.4, 0.9;
  for (Index i = kColumns; i < 2 * kColumns; ++i) shape.moves.row(i) << 0, -0.3, 1.6;
  const Displacements gentle{shape.vertices, 0.6 * shape.moves};
  ASSERT_EQ(pairs_in(flat, gentle), 0U);
  Displacements steep{shape.vertices, 1.3 * shape.moves};
  ASSERT_GT(pairs_in(flat, steep), 0U);
  const auto searched_skin = crossings_.find_searched_skin(flat, gentle, {});
  const Displacements result = mended(flat, steep, searched_skin);
  EXPECT_EQ(pairs_in(flat, result), 0U);
}

TEST_F(SkinCrossingsTest, FarSkinThatAFaceHasNearIsWatched) {
  const Displacements shape = pressed(folded(3), 0.9);
  const auto searched_skin = crossings_.find_searched_skin(folded(3), shape, {});
  const Positions face = folded(0.5);
  ASSERT_GT(pairs_in(face, shape), 20U);
  EXPECT_EQ(pairs_in(face, mended(face, shape, searched_skin)), 0U);
}

TEST_F(SkinCrossingsTest, LidsComeToLieAsOnTheTemplate) {
  std::vector<signed char> side(skin_.size(), -1);
  std::fill(side.begin() + static_cast<std::ptrdiff_t>(side.size() / 2), side.end(), 1);
  const Displacements shape = closing(folded(1), 0.9, 0.3);
  const auto searched_skin = crossings_.find_searched_skin(folded(1), shape, std::move(side));
  const Positions face = folded(0.6);
  ASSERT_GT(pairs_in(face, shape), 20U);
  const Displacements result = mended(face, shape, searched_skin);
  EXPECT_EQ(pairs_in(face, result), 0U);
  EXPECT_EQ(result.vertices, shape.vertices);
  const double closed = result.moves.col(1).maxCoeff() - result.moves.col(1).minCoeff();
  EXPECT_GT(closed, 0.45) << "lids close still";
  EXPECT_LT(closed, 0.6);
}

TEST_F(SkinCrossingsTest, WithoutAnyNothingChanges) {
  const Positions face = folded(1.1);
  const Displacements shape = pressed(folded(1), 0.9);
  const Displacements result =
      mended(face, shape, crossings_.find_searched_skin(folded(1), shape, {}));
  EXPECT_EQ(result.moves, shape.moves);
}

TEST_F(SkinCrossingsTest, FarFromThemNothingChanges) {
  const Positions face = folded(0.6);
  Displacements shape = pressed(folded(1), 0.9);
  const auto searched_skin = crossings_.find_searched_skin(folded(1), shape, {});
  const Displacements result = mended(face, shape, searched_skin);
  std::size_t same = 0;
  for (Index i = 0; i < shape.moves.rows(); ++i) same += result.moves.row(i) == shape.moves.row(i);
  EXPECT_GT(same, 10U);
  EXPECT_LT(same, shape.vertices.size());
}

TEST_F(SkinCrossingsTest, OfTheTemplateAndOfTheFaceAtRestStay) {
  const Displacements through = pressed(folded(1), 1.4);
  ASSERT_GT(pairs_in(folded(1), through), 20U);
  const auto searched_skin = crossings_.find_searched_skin(folded(1), through, {});
  EXPECT_EQ(mended(folded(1), through, searched_skin).moves, through.moves);

  Positions crossed = folded(0.6);
  through.add_to(crossed);
  Displacements little = pressed(folded(1), 0.05);
  ASSERT_GT(pairs_in(crossed, little), 20U);
  EXPECT_EQ(mended(crossed, little, crossings_.find_searched_skin(folded(1), little, {})).moves,
            little.moves);
}

TEST_F(SkinCrossingsTest, SkinThatAShapeDoesNotBringTogetherIsNotWatched) {
  const Displacements shape = pressed(folded(6), 0.1);
  EXPECT_TRUE(crossings_.find_searched_skin(folded(6), shape, {}).search.triangles().empty());
}

}  // namespace
}  // namespace crowdface
