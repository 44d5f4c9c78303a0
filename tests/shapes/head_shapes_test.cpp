// SPDX-License-Identifier: Apache-2.0
// A set of shapes for each head.
#include <gtest/gtest.h>

#include "shapes/acting_heads.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;
using namespace testing;

/// Every head with shapes made for it.
ShapeSet sets_of(const Heads& heads) {
  ShapeSet set{mean_head(heads.faces), {}};
  std::vector<std::string> names;
  for (const Head& head : heads.faces.heads) {
    std::vector<OwnShape>& own = set.head_shapes.emplace_back();
    names.clear();
    for (const Shape& shape : shapes_of(heads, head.positions).shapes) {
      own.push_back(make_own_shape(shape.moves));
      names.push_back(shape.name);
    }
  }
  for (std::size_t s = 0; s < names.size(); ++s) {
    set.shapes.push_back({names[s], mean_displacements(set.head_shapes, s)});
  }
  return set;
}

RegionWeights one_region(const Heads& heads) {
  return whole_head_weights(heads.faces.topology);
}

std::vector<RegionShares> everywhere(const ShapeSet& set, const ShapeSetShares& shares) {
  return {set.shapes.size(), RegionShares{shares}};
}

Positions in_shape(const Positions& face, const Displacements& moves) {
  Positions shape = face;
  moves.add_to(shape);
  return shape;
}

TEST(HeadShapes, AHeadHasItsOwn) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = sets_of(heads);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set,
                               one_region(heads));
  for (const std::uint32_t h : {1U, 4U}) {
    const auto carried = transfer.transfer_to_face(h, heads[h], everywhere(set, {{h, 1}}));
    for (std::size_t s = 0; s < set.shapes.size(); ++s) {
      const Positions own = in_shape(heads[h], displacements_of(set.head_shapes[h][s]));
      const Positions mean = in_shape(heads[h], set.shapes[s].moves);
      const double off = (in_shape(heads[h], carried[s]) - own).cwiseAbs().maxCoeff();
      EXPECT_LT(off, 1e-6) << set.shapes[s].name;
      if (s < 3) {
        EXPECT_GT((mean - own).cwiseAbs().maxCoeff(), 1e-3) << "not to be told from the mean";
      }
    }
  }
}

TEST(HeadShapes, OfHeadsThatAreTheSameAreThoseOfEither) {
  Heads heads = synthetic_heads();
  heads.faces.heads[3].positions = heads[1];
  const ShapeSet set = sets_of(heads);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set,
                               one_region(heads));
  const auto carried =
      transfer.transfer_to_face(1, heads[1], everywhere(set, {{1, 0.3}, {3, 0.7}}));
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    const Positions own = in_shape(heads[1], displacements_of(set.head_shapes[1][s]));
    EXPECT_LT((in_shape(heads[1], carried[s]) - own).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(HeadShapes, AShapeOfZeroInAllHeadsMovesNothing) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = sets_of(heads);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set,
                               one_region(heads));
  const Positions face = (heads[0] + heads[2]) / 2;
  const auto carried = transfer.transfer_to_face(0, face, everywhere(set, {{0, 0.5}, {2, 0.5}}));
  EXPECT_EQ(in_shape(face, carried.back()), face);
}

/// A face half-way between two heads closes its eye half-way between theirs.
TEST(HeadShapes, ABlinkClosesBetweenTwoHeads) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = sets_of(heads);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set,
                               one_region(heads));
  const Rims rims = rims_of(heads, *heads.eyes().at(0), set.neutral);
  const Positions face = (heads[2] + heads[5]) / 2;
  const auto gap = [&](const Positions& mesh, std::size_t i) {
    return mesh(rims.high[i], 1) - mesh(rims.low[i], 1);
  };
  const Positions closed =
      in_shape(face, transfer.transfer_to_face(2, face, everywhere(set, {{2, 0.5}, {5, 0.5}}))[0]);
  for (std::size_t i = 0; i < rims.low.size(); ++i) {
    double wanted = 0;
    for (const std::size_t h : {2, 5}) {
      wanted += gap(in_shape(heads[h], displacements_of(set.head_shapes[h][0])), i) / 2;
    }
    EXPECT_NEAR(gap(closed, i), wanted, 0.08) << i;
    EXPECT_GT(gap(face, i), 0.3);
  }
}

/// Each region has the shapes of its own heads.
TEST(HeadShapes, ComeRegionByRegion) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = sets_of(heads);
  RegionWeights halves;
  halves.alpha.setZero(set.neutral.rows(), 2);
  for (Index v = 0; v < set.neutral.rows(); ++v)
    halves.alpha(v, set.neutral(v, 1) < -2 ? 0 : 1) = 1;
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set, halves);
  const RegionShares mouth_of_two = {{{2, 1}}, {{4, 1}}};
  const auto carried =
      transfer.transfer_to_face(4, heads[4], std::vector(set.shapes.size(), mouth_of_two));
  const Positions own_blink = in_shape(heads[4], displacements_of(set.head_shapes[4][0]));
  EXPECT_LT((in_shape(heads[4], carried[0]) - own_blink).cwiseAbs().maxCoeff(), 1e-6);
  const auto other = transfer.transfer_to_face(4, heads[4], everywhere(set, {{2, 1}}));
  const Displacements& smile = carried[1];
  for (std::size_t i = 0; i < smile.vertices.size(); ++i) {
    if (set.neutral(smile.vertices[i], 1) >= -2) continue;
    EXPECT_EQ(smile.moves.row(static_cast<Index>(i)), other[1].moves.row(static_cast<Index>(i)));
  }
}

}  // namespace
}  // namespace crowdface
