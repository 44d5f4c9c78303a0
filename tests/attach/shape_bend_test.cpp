// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/shape_bend.h"

#include <memory>
#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kColumns = 21, kRows = 61;

/// A sheet of squares of one millimetre, folded in its middle: the lower half lies two millimetres below.
class FoldedSheet : public ::testing::Test {
 protected:
  FoldedSheet() : mesh_(kColumns * kRows, 3) {
    topology_.vertex_count = kColumns * kRows;
    topology_.face_offsets = {0};
    for (std::uint32_t r = 0; r < kRows; ++r) {
      const double along = static_cast<double>(r) - 30;
      for (std::uint32_t c = 0; c < kColumns; ++c) {
        mesh_.row(r * kColumns + c) << c, std::abs(along), along < 0 ? 0 : 2;
        if (r + 1 == kRows || c + 1 == kColumns) continue;
        const std::uint32_t v = r * kColumns + c;
        for (const std::uint32_t corner : {v, v + 1, v + kColumns + 1, v + kColumns}) {
          topology_.corner_vertices.push_back(corner);
        }
        topology_.face_offsets.push_back(
            static_cast<std::uint32_t>(topology_.corner_vertices.size()));
      }
    }
    std::vector<std::uint32_t> skin(kColumns * kRows);
    std::iota(skin.begin(), skin.end(), 0U);
    skin_ = std::make_unique<FittedSkin>(topology_, mesh_, skin, 1);
    apart_.vertex_count = 2;
    apart_.face_offsets = {0};
    points_.resize(2, 3);
    points_ << 10, 25, 2.5, 10, 25, -0.5;  // above the upper sheet and below the lower one
  }
  /// Of the lower sheet's outer half.
  Displacements lowered() const {
    Displacements shape;
    for (std::uint32_t v = 0; v < kColumns * 18; ++v) shape.vertices.push_back(v);
    shape.moves = Positions::Zero(static_cast<Index>(shape.vertices.size()), 3);
    shape.moves.col(2).setConstant(-3);
    return shape;
  }

  Topology topology_, apart_;
  Positions mesh_, points_;
  std::unique_ptr<FittedSkin> skin_;
};

TEST_F(FoldedSheet, TakesAlongWhatLiesOnTheSkinThatMovesAndNothingElse) {
  const ShapeBend bend(*skin_, build_adjacency(topology_), apart_, points_);
  const Displacements moves = bend.shape_displacements(mesh_, points_, lowered());
  ASSERT_EQ(moves.vertices, std::vector<std::uint32_t>{1}) << "the upper sheet stays";
  EXPECT_LT((row3(moves.moves, 0) - Eigen::Vector3d(0, 0, -3)).norm(), 1e-9);
}

/// A lash of the lower lid, whose tip is nearer to the upper one.
TEST_F(FoldedSheet, TakesAlongWholeWhatGrowsOnTheSkinThatMoves) {
  Positions lash(4, 3);
  lash << 10, 30, -0.1, 10, 30.5, 0.5, 10, 30.6, 1.3, 10, 30.3, 1.9;
  Topology strip;
  strip.vertex_count = 4;
  strip.face_offsets = {0, 3, 6};
  strip.corner_vertices = {0, 1, 2, 1, 2, 3};
  const ShapeBend bend(*skin_, build_adjacency(topology_), strip, lash);
  const Displacements moves = bend.shape_displacements(mesh_, lash, lowered());
  ASSERT_EQ(moves.vertices.size(), 4U);
  for (Index v = 0; v < 4; ++v) {
    EXPECT_LT((row3(moves.moves, v) - Eigen::Vector3d(0, 0, -3)).norm(), 1e-9) << v;
  }
}

TEST_F(FoldedSheet, StaysWhereTheSkinStays) {
  const ShapeBend bend(*skin_, build_adjacency(topology_), apart_, points_);
  EXPECT_TRUE(bend.shape_displacements(mesh_, points_, {{}, Positions(0, 3)}).vertices.empty());
}

}  // namespace
}  // namespace crowdface
