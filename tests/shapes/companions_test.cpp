// SPDX-License-Identifier: Apache-2.0
// Shapes that are made to be added to another, as ARKit's mouthClose is to jawOpen.
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/mesh/triangles.h"
#include "crowdface/shapes/prepared_shapes.h"
#include "crowdface/shapes/shape_transfer.h"
#include "crowdface/validity/intersections.h"

#include "parts/slotted_roller.h"

namespace crowdface {
namespace {

using testing::slotted_roller;

constexpr double kGap = 0.1, kOpen = 1, kRollerExtent = 13;

/// Three rollers with a slot whose lower wall `jawOpen` takes down; `mouthClose` brings both
/// together.
class CompanionsTest : public ::testing::Test {
 protected:
  CompanionsTest() {
    for (const double gap : {kGap, 0.04, 0.12}) {
      Mesh mesh = slotted_roller(gap);
      faces_.topology = mesh.topology;
      faces_.heads.push_back({"head", std::move(mesh.positions)});
    }
    skin_.resize(static_cast<std::size_t>(faces_.topology.vertex_count));
    std::iota(skin_.begin(), skin_.end(), 0U);
    adjacency_ = build_adjacency(faces_.topology);
    set_.neutral = faces_.heads.front().positions;
    set_.shapes = {{"cheekPuff", walls({0.1, 0, 0}, {0.1, 0, 0})},
                   {"jawOpen", walls({0, -kOpen, 0}, {0, 0, 0})},
                   {"mouthClose", walls({0, 0.8, 0}, {0, -0.26, 0})},
                   {"mouthLeft", walls({0.2, 0, 0}, {0.2, 0, 0})}};
  }
  Displacements walls(const Eigen::RowVector3d& lower, const Eigen::RowVector3d& upper) const {
    Displacements shape;
    std::vector<Eigen::RowVector3d> moves;
    for (const std::uint32_t v : skin_) {
      const Eigen::RowVector3d at = set_.neutral.row(v);
      const double off = std::hypot(at.x() / 3, (at.z() - 2.4) / 2);
      if (std::abs(std::abs(at.y()) - kGap / 2) > 1e-9 || off >= 1) continue;
      shape.vertices.push_back(v);
      moves.push_back((1 - off * off) * (1 - off * off) * (at.y() < 0 ? lower : upper));
    }
    shape.moves.resize(static_cast<Index>(moves.size()), 3);
    for (std::size_t i = 0; i < moves.size(); ++i) {
      shape.moves.row(static_cast<Index>(i)) = moves[i];
    }
    return shape;
  }
  std::size_t crossing(const Positions& face, const Displacements& one,
                       const Displacements& other) const {
    Positions mesh = face;
    one.add_to(mesh);
    other.add_to(mesh);
    const std::vector<Triangle> triangles = triangles_of(faces_.topology);
    return intersecting_pairs(triangles, mesh, near_pairs(triangles, mesh, 0)).size();
  }

  HeadSet faces_;
  Adjacency adjacency_;
  std::vector<std::uint32_t> skin_;
  ShapeSet set_;
};

TEST_F(CompanionsTest, AreFoundByHowLipsLie) {
  const GapPreserver contacts(faces_, adjacency_, skin_);
  const std::vector<std::optional<std::size_t>> expected = {std::nullopt, std::nullopt, 1,
                                                            std::nullopt};
  EXPECT_EQ(find_prerequisites(set_, contacts, kRollerExtent), expected);
  set_.shapes.erase(set_.shapes.begin() + 1);
  EXPECT_EQ(find_prerequisites(set_, contacts, kRollerExtent),
            std::vector<std::optional<std::size_t>>(3, std::nullopt))
      << "none brings them back";
}

TEST_F(CompanionsTest, LipsThatComeTogetherAgainDoNotPassThroughEachOther) {
  const auto& [open, close] = std::pair(set_.shapes[1].moves, set_.shapes[2].moves);
  const Positions& face = faces_.heads[1].positions;
  ASSERT_EQ(crossing(set_.neutral, open, close), 0U);
  ASSERT_GT(crossing(face, open, close), 40U);
  const ShapeTransfer transfer(faces_, adjacency_, {}, {}, set_);
  EXPECT_EQ(transfer.prerequisite_of(2), 1U);
  EXPECT_EQ(transfer.prerequisite_of(1), std::nullopt);
  std::vector<Index> left;
  const std::vector<Displacements> moves = transfer.transfer_to_face(1, face, {}, &left);
  EXPECT_EQ(left[2], 0);
  EXPECT_EQ(crossing(face, moves[1], moves[2]), 0U);
  EXPECT_LT((moves[2].moves - close.moves).cwiseAbs().maxCoeff(), 0.12) << "they close still";
}

}  // namespace
}  // namespace crowdface
