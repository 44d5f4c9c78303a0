// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/intersections.h"

#include <algorithm>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/core/require.h"
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
/// What is outside of it is above.
Eigen::Vector3d domed(double x, double y) {
  return {x, y, 0.02 * x * (24 - x)};
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
  EXPECT_EQ(intersecting_pairs(sheet.triangles, crossing, near_pairs(sheet.triangles, crossing, 0)),
            expected);
  EXPECT_TRUE(intersecting_pairs(sheet.triangles, sheet.lie(flat),
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

TEST(TriangleScene, PairsAreTheSameWhateverTheTreeWasMadeOf) {
  const Sheet sheet;
  const Positions positions = sheet.lie(bent);
  std::vector<TrianglePair> expected;  // by trying all
  for (std::uint32_t a = 0; a < sheet.triangles.size(); ++a) {
    for (std::uint32_t b = a + 1; b < sheet.triangles.size(); ++b) {
      const Triangle &s = sheet.triangles[a], &t = sheet.triangles[b];
      bool apart = share_vertex(s, t);
      for (Index c = 0; c < 3; ++c) {
        const auto [s_low, s_high] =
            std::minmax({positions(s[0], c), positions(s[1], c), positions(s[2], c)});
        const auto [t_low, t_high] =
            std::minmax({positions(t[0], c), positions(t[1], c), positions(t[2], c)});
        apart = apart || s_low - t_high > 0.74 || t_low - s_high > 0.74;
      }
      if (!apart) expected.emplace_back(a, b);
    }
  }
  ASSERT_GT(expected.size(), 2000U);
  const auto crossing = intersecting_pairs(sheet.triangles, positions, expected);
  ASSERT_GT(crossing.size(), 20U);
  for (const auto& place : {flat, domed, bent}) {
    const TriangleTree tree(sheet.triangles, sheet.lie(place));
    const TriangleScene scene(sheet.triangles, tree, positions, 0.37);
    EXPECT_EQ(scene.near_pairs(), expected);
    EXPECT_EQ(scene.intersecting_pairs(), crossing);
  }
}

TEST(SkinCheck, CountsWhatTheTargetHasNot) {
  const Sheet sheet;
  const std::vector<Head> heads = {{"flat", sheet.lie(flat)}, {"bent", sheet.lie(bent)}};
  const SkinCheck check(sheet.topology, sheet.components, heads, {0, 1}, {{{0, 0, 1}}, 1});
  EXPECT_EQ(check.compare(heads[0].positions, 0).intersecting_triangle_count, 0);
  EXPECT_GT(check.compare(heads[1].positions, 0).intersecting_triangle_count, 20);
  EXPECT_EQ(check.compare(heads[1].positions, 1).intersecting_triangle_count, 0)
      << "the target's own";
  EXPECT_EQ(check.compare(heads[0].positions, 0).local.flipped_triangle_count, 0);
  EXPECT_GT(check.compare(heads[1].positions, 0).local.flipped_triangle_count, 100);
}

TEST(SkinCheck, NeedsAHead) {
  const Sheet sheet;
  EXPECT_THROW(SkinCheck(sheet.topology, sheet.components, {}, {}, {}), BrokenPrecondition);
}

/// Of the bent sheet, what is above the flat half: a viewer above sees its back.
double area_of_flap(const Sheet& sheet, const Positions& positions) {
  double area = 0;
  for (const Triangle& triangle : sheet.triangles) {
    const Eigen::Vector3d doubled = area_vector(positions, triangle);
    const double height =
        positions(triangle[0], 2) + positions(triangle[1], 2) + positions(triangle[2], 2);
    if (doubled.z() < 0 && height > 0) area += 0.5 * doubled.norm();
  }
  return area;
}

TEST(SkinCheck, MeasuresSkinThatShowsItsBack) {
  const Sheet sheet;
  const std::vector<Head> heads = {{"domed", sheet.lie(domed)}, {"bent", sheet.lie(bent)}};
  const double flap = area_of_flap(sheet, heads[1].positions);
  ASSERT_GT(flap, 50);
  ASSERT_LT(flap, 200);
  const ViewSetup above{{{0, 0, 1}}, 10};
  const SkinCheck check(sheet.topology, sheet.components, heads, {0, 1}, above);
  EXPECT_EQ(check.compare(heads[0].positions, 0).exposed_back_face_mm2, 0);
  EXPECT_NEAR(check.compare(heads[1].positions, 0).exposed_back_face_mm2, 100 * flap, 6 * flap);
  EXPECT_EQ(check.compare(heads[1].positions, 1).exposed_back_face_mm2, 0) << "the target's own";
  const ViewSetup nobody{{}, 10};
  const SkinCheck unseen(sheet.topology, sheet.components, heads, {0}, nobody);
  EXPECT_EQ(unseen.compare(heads[1].positions, 0).exposed_back_face_mm2, 0);
}

TEST(TriangleScene, RaysMeetWhatTryingAllTrianglesMeets) {
  const Sheet sheet;
  const Positions positions = sheet.lie(bent);
  const TriangleTree tree(sheet.triangles, sheet.lie(flat));
  const TriangleScene scene(sheet.triangles, tree, positions, 1e-4);
  const auto crosses = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                           const Triangle& triangle) {
    Eigen::Matrix3d edges;
    const Eigen::Vector3d a = positions.row(triangle[0]).transpose();
    edges << positions.row(triangle[1]).transpose() - a, positions.row(triangle[2]).transpose() - a,
        -direction;
    const Eigen::Vector3d solved = edges.inverse() * (origin - a);
    return solved.x() >= 0 && solved.y() >= 0 && solved.x() + solved.y() <= 1 && solved.z() > 0;
  };
  int met = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto [u, v] = random_pair({1, i, "origin"});
    const auto [p, q] = random_pair({1, i, "direction"});
    const Eigen::Vector3d origin(26 * u - 1, 26 * v - 1, 6 * p - 2);
    const Eigen::Vector3d direction(q - 0.5, p - 0.5, u - 0.5);
    const bool expected =
        std::any_of(sheet.triangles.begin(), sheet.triangles.end(),
                    [&](const Triangle& triangle) { return crosses(origin, direction, triangle); });
    const std::array guesses = {kNoIndex, static_cast<std::uint32_t>(i % tree.order.size())};
    for (const std::uint32_t guess : guesses) {
      const std::uint32_t other = scene.find_any_hit(origin, direction, kNoIndex, guess);
      EXPECT_EQ(other != kNoIndex, expected) << i;
      EXPECT_TRUE(other == kNoIndex ||
                  crosses(origin, direction, sheet.triangles[tree.order[other]]));
    }
    met += expected ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 250);
  const Eigen::Vector3d up(0, 0, 1);
  const Eigen::Vector3d below(3.3, 7.4, -1);
  EXPECT_NE(scene.find_any_hit(below, up, kNoIndex, kNoIndex), kNoIndex);
}

}  // namespace
}  // namespace crowdface
