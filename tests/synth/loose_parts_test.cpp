// SPDX-License-Identifier: Apache-2.0
// The pieces of synthetic heads beside the skin.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "crowdface/mesh/adjacency.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

/// A component of a head, which is called like one of the pieces.
struct Piece {
  std::vector<std::uint32_t> vertices;
  Vector3d low, high;
  Vector3d middle() const { return (low + high) / 2; }
};

struct Heads {
  SyntheticHeads heads{12000, SyntheticHeads::Parts::kEyesAndTeeth};
  Adjacency adjacency = build_adjacency(heads.topology());
  Components components = find_components(adjacency);

  Piece piece(const std::string& name, const Positions& head) const {
    const auto pieces = heads.pieces();
    const auto named = std::find_if(pieces.begin(), pieces.end(),
                                    [&](const auto& piece) { return piece.name == name; });
    const std::uint32_t component =
        components.component_of_vertex[heads.topology().face(named->first_face)[0]];
    Piece piece{{}, Vector3d::Constant(1e300), Vector3d::Constant(-1e300)};
    for (std::uint32_t v = 0; v < components.component_of_vertex.size(); ++v) {
      if (components.component_of_vertex[v] != component) continue;
      piece.vertices.push_back(v);
      piece.low = piece.low.cwiseMin(head.row(v).transpose());
      piece.high = piece.high.cwiseMax(head.row(v).transpose());
    }
    return piece;
  }
};

const Heads& heads() {
  static const Heads heads;
  return heads;
}

constexpr const char* kNames[] = {"eyeball_left", "eyeball_right", "teeth_upper", "teeth_lower"};

TEST(LoosePieces, AreClosedComponentsOfTheirOwn) {
  EXPECT_EQ(heads().components.count(), 5);
  const Positions head = heads().heads.positions(1, 0);
  std::set<std::uint32_t> of_pieces;
  for (const char* name : kNames) {
    const Piece piece = heads().piece(name, head);
    of_pieces.insert(heads().components.component_of_vertex[piece.vertices[0]]);
    for (const std::uint32_t v : piece.vertices)
      ASSERT_FALSE(heads().adjacency.boundary[v]) << name;
  }
  EXPECT_EQ(of_pieces.size(), 4U);
  EXPECT_FALSE(of_pieces.contains(heads().components.largest()));
}

TEST(LoosePieces, HoldEyeballsBehindTheLids) {
  const std::uint32_t skin = heads().components.largest();
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Positions head = heads().heads.positions(1, i);
    for (const char* name : {"eyeball_left", "eyeball_right"}) {
      const Piece eye = heads().piece(name, head);
      const Vector3d centre = eye.middle();
      const double radius = (eye.high - eye.low).x() / 2;
      for (const std::uint32_t v : eye.vertices) {
        EXPECT_NEAR((head.row(v).transpose() - centre).norm(), radius, 0.12 * radius);
      }
      int above = 0, below = 0, inside = 0;
      for (Index v = 0; v < head.rows(); ++v) {
        if (heads().components.component_of_vertex[static_cast<std::size_t>(v)] != skin) continue;
        const Vector3d from = head.row(v).transpose() - centre;
        if (from.z() < 0 || from.norm() > 1.25 * radius) continue;
        (from.y() > 0 ? above : below) += 1;
        inside += from.norm() < 0.95 * radius ? 1 : 0;
      }
      EXPECT_GT(above, 10) << name;
      EXPECT_GT(below, 10) << name;
      EXPECT_EQ(inside, 0) << name << ", head " << i;
    }
    EXPECT_GT(heads().piece("eyeball_left", head).middle().x(), 1);
    EXPECT_LT(heads().piece("eyeball_right", head).middle().x(), -1);
  }
}

TEST(LoosePieces, HoldTwoRowsOfTeethBehindTheLips) {
  const std::uint32_t skin = heads().components.largest();
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Positions head = heads().heads.positions(1, i);
    const Piece upper = heads().piece("teeth_upper", head);
    const Piece lower = heads().piece("teeth_lower", head);
    EXPECT_GT(upper.middle().y(), lower.middle().y() + 0.3);
    for (const Piece& row : {upper, lower}) {
      double lips = -1e300;
      for (Index v = 0; v < head.rows(); ++v) {
        if (heads().components.component_of_vertex[static_cast<std::size_t>(v)] != skin) continue;
        const bool beside = std::abs(head(v, 0) - row.middle().x()) < 1;
        if (beside && head(v, 1) > row.low.y() && head(v, 1) < row.high.y()) {
          lips = std::max(lips, head(v, 2));
        }
      }
      EXPECT_LT(row.high.z(), lips - 0.2) << "head " << i;
    }
  }
}

}  // namespace
}  // namespace crowdface
