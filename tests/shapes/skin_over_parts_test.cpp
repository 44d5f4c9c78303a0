// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/skin_over_parts.h"

#include <gtest/gtest.h>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kSide = 21;
constexpr double kFlatExtent = 430, kDepth = 0.43;

/// A sheet that looks to the front, four apart, and one vertex behind its middle.
class SkinOverPartsTest : public ::testing::Test {
 protected:
  SkinOverPartsTest() {
    skin_.vertex_triangles = compressed_rows<std::uint32_t>(kInner + 1, [&](const auto& put) {
      for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
        for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
          const std::uint32_t a = y * kSide + x;
          for (const Triangle& triangle :
               {Triangle{a, a + 1, a + kSide + 1}, Triangle{a, a + kSide + 1, a + kSide}}) {
            for (const std::uint32_t v : triangle)
              put(v, static_cast<std::uint32_t>(skin_.triangles.size()));
            skin_.triangles.push_back(triangle);
          }
        }
      }
    });
    for (std::uint32_t v = 0; v < kInner; ++v) {
      skin_.vertices.push_back(v);
      rows_.push_back({v, v});
    }
  }

  static Positions sheet(double depth) {
    Positions positions(kInner + 1, 3);
    for (std::uint32_t v = 0; v < kInner; ++v) {
      positions.row(v) << 4.0 * (v % kSide) - 40, 4.0 * (v / kSide) - 40, 0;
    }
    positions.row(kInner) << 0.7, 0.4, -depth;
    return positions;
  }
  Displacements kept(const SkinOverParts& over, const Positions& face,
                     const RigidMotion& whole = {}) const {
    Displacements shape = back(2);
    turn(whole, shape.moves);
    Positions mesh = face;
    over.keep_in_front(face, whole, rows_, mesh, shape);
    EXPECT_EQ(mesh, face);
    return shape;
  }
  static void turn(const RigidMotion& by, Positions& rows) {
    for (Index i = 0; i < rows.rows(); ++i)
      rows.row(i) = by.apply_to_direction(row3(rows, i)).transpose();
  }
  /// All of the skin goes back.
  Displacements back(double by) const {
    Displacements shape{skin_.vertices, Positions::Zero(kInner, 3)};
    shape.moves.col(2).setConstant(-by);
    return shape;
  }
  SkinOverParts over_template() const {
    Positions shaped = sheet(4);
    back(2).add_to(shaped);
    return {shaped, skin_, std::vector<std::uint32_t>{kInner}, skin_.vertices, {}, kFlatExtent};
  }

  static constexpr std::uint32_t kInner = kSide * kSide;
  SkinTriangles skin_;
  std::vector<DisplacementRow> rows_;
};

TEST_F(SkinOverPartsTest, StaysOverThemOnAnotherFace) {
  const Displacements shape = kept(over_template(), sheet(1));
  const Index middle = kInner / 2;
  EXPECT_GT(shape.moves(middle, 2), -1 + kDepth / 4);
  EXPECT_LT(shape.moves(middle, 2), -1 + 1.5 * kDepth) << "no further out than needed";
  EXPECT_EQ(shape.moves.row(0), back(2).moves.row(0)) << "far from it";
  EXPECT_GT(shape.moves(middle + 1, 2), -2) << "skin around goes along";
  EXPECT_LT(shape.moves(middle + 1, 2), shape.moves(middle, 2));
}

TEST_F(SkinOverPartsTest, StaysOverThemOnAFaceThatIsTurned) {
  RigidMotion whole;
  whole.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Positions face = sheet(1);
  turn(whole, face);
  Displacements expected = kept(over_template(), sheet(1));
  turn(whole, expected.moves);
  EXPECT_LT((kept(over_template(), face, whole).moves - expected.moves).cwiseAbs().maxCoeff(),
            1e-9);
}

TEST_F(SkinOverPartsTest, NothingMovesWhereNothingIsInTheWay) {
  EXPECT_EQ(kept(over_template(), sheet(4)).moves, back(2).moves);
}

TEST_F(SkinOverPartsTest, WhatIsBareOnTheTemplateMayBeOnAFace) {
  Positions shaped = sheet(1);
  back(2).add_to(shaped);
  const SkinOverParts over(shaped, skin_, std::vector<std::uint32_t>{kInner}, skin_.vertices, {},
                           kFlatExtent);
  EXPECT_EQ(kept(over, sheet(1)).moves, back(2).moves);
}

}  // namespace
}  // namespace crowdface
