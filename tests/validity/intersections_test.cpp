// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/intersections.h"

#include <gtest/gtest.h>

#include "crowdface/validity/skin_check.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

/// A sheet of n by n squares that lies as `place` says.
struct Sheet {
  Sheet() : topology(testing::grid_topology(24, 24)) {
    components = find_components(build_adjacency(topology));
    triangles = triangles_of(topology, components, components.largest());
  }
  template <class Place>
  Positions lie(const Place& place) const {
    Positions positions(topology.vertex_count, 3);
    for (Index i = 0; i < positions.rows(); ++i) {
      positions.row(i) =
          place(static_cast<double>(i % 25), static_cast<double>(i / 25)).transpose();
    }
    return positions;
  }
  Topology topology;
  Components components;
  std::vector<Triangle> triangles;
};

std::vector<TrianglePair> by_trying_all(const std::vector<Triangle>& triangles,
                                        const Positions& positions) {
  std::vector<TrianglePair> found;
  for (std::uint32_t a = 0; a < triangles.size(); ++a) {
    for (std::uint32_t b = a + 1; b < triangles.size(); ++b) {
      if (!share_vertex(triangles[a], triangles[b]) &&
          triangles_intersect(positions, triangles[a], triangles[b])) {
        found.emplace_back(a, b);
      }
    }
  }
  return found;
}

Eigen::Vector3d flat(double x, double y) {
  return {x, y, 0.1 * x};
}
/// Bent over so that the far side comes down through the near one.
Eigen::Vector3d bent(double x, double y) {
  return x < 12 ? Eigen::Vector3d(x, y, 0) : Eigen::Vector3d(24 - x, y + 0.3, 3.1 - 0.5 * (x - 12));
}

TEST(Intersections, AreThoseOfTryingAllPairs) {
  const Sheet sheet;
  const Positions crossing = sheet.lie(bent);
  const auto expected = by_trying_all(sheet.triangles, crossing);
  EXPECT_GT(expected.size(), 20U);
  EXPECT_EQ(intersecting(sheet.triangles, crossing, near_pairs(sheet.triangles, crossing, 0)),
            expected);
  EXPECT_TRUE(intersecting(sheet.triangles, sheet.lie(flat),
                           near_pairs(sheet.triangles, sheet.lie(flat), 0))
                  .empty());
}

// Of 60,000 at one vertex the pairs of boxes took a minute and a half for each face.
TEST(Intersections, TrianglesAtAVertexOfVeryManyAreLeftOut) {
  constexpr std::uint32_t kAround = 1001;
  Positions positions(kAround + 4, 3);
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= kAround; ++i) {
    positions.row(i) << std::cos(0.006 * i), std::sin(0.006 * i), 0;
    if (i > 1) triangles.push_back({0, i - 1, i});
  }
  triangles.push_back({0, 1, kAround});
  positions.row(0).setZero();
  // Two that cross each other, and many of the others.
  positions.row(kAround + 1) << -2, -2, -1;
  positions.row(kAround + 2) << 2, -2, 1;
  positions.row(kAround + 3) << 0, 2, 0.1;
  triangles.push_back({kAround + 1, kAround + 2, kAround + 3});
  EXPECT_TRUE(near_pairs(triangles, positions, 0).empty());
  triangles.erase(triangles.begin(), triangles.begin() + 2);
  EXPECT_FALSE(near_pairs(triangles, positions, 0).empty());
}

TEST(Intersections, NearPairsGrowWithTheMargin) {
  const Sheet sheet;
  const Positions positions = sheet.lie(flat);
  std::size_t before = 0;
  for (const double margin : {0.0, 0.5, 1.5}) {
    const auto pairs = near_pairs(sheet.triangles, positions, margin);
    EXPECT_GT(pairs.size(), before);
    before = pairs.size();
    for (const auto& [a, b] : pairs)
      EXPECT_FALSE(share_vertex(sheet.triangles[a], sheet.triangles[b]));
  }
}

TEST(SkinCheck, CountsWhatTheTargetHasNot) {
  const Sheet sheet;
  const std::vector<Head> heads = {{"flat", sheet.lie(flat)}, {"bent", sheet.lie(bent)}};
  const SkinCheck check(sheet.topology, sheet.components, heads, {0, 1});
  EXPECT_EQ(check.compare(heads[0].positions, 0).intersecting, 0);
  EXPECT_GT(check.compare(heads[1].positions, 0).intersecting, 20);
  EXPECT_EQ(check.compare(heads[1].positions, 1).intersecting, 0) << "the target's own";
  EXPECT_EQ(check.compare(heads[0].positions, 0).local.flipped, 0);
  EXPECT_GT(check.compare(heads[1].positions, 0).local.flipped, 100);
}

}  // namespace
}  // namespace crowdface
