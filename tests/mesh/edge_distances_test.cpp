// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/edge_distances.h"

#include <cmath>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// A row of n vertices a unit apart, joined by thin triangles to a second row far off.
struct Row {
  explicit Row(std::uint32_t n) {
    topology.vertex_count = 2 * n;
    positions.resize(2 * n, 3);
    for (std::uint32_t i = 0; i < n; ++i) {
      positions.row(i) << i, 0, 0;
      positions.row(n + i) << i, 100, 0;
      if (i == 0) continue;
      topology.corner_vertices.insert(topology.corner_vertices.end(), {i - 1, i, n + i, n + i - 1});
      topology.face_offsets.push_back(4 * i);
    }
    adjacency = build_adjacency(topology);
  }
  Topology topology;
  Positions positions;
  Adjacency adjacency;
};

TEST(EdgeDistances, AddUpAlongTheNearestWayAndNameTheirSource) {
  const Row row(9);
  EdgeDistances distances(row.adjacency, row.positions);
  const std::uint32_t ends[] = {0, 8};
  distances.search(ends);
  for (std::uint32_t v = 0; v < 9; ++v) {
    EXPECT_DOUBLE_EQ(distances.distance(v), std::min(v, 8 - v)) << v;
    EXPECT_DOUBLE_EQ(distances.distance(9 + v), 100 + std::min(v, 8 - v)) << v;
    EXPECT_EQ(distances.nearest_source(v), v <= 4 ? 0U : 1U) << "of equally near ones the first";
  }
  EXPECT_EQ(distances.reached().size(), 18U);
}

TEST(EdgeDistances, EndAtTheLimitAndForgetTheSearchBefore) {
  const Row row(9);
  EdgeDistances distances(row.adjacency, row.positions);
  const std::uint32_t first[] = {0}, last[] = {8};
  distances.search(first, 3);
  EXPECT_EQ(distances.reached().size(), 4U);
  EXPECT_TRUE(std::isinf(distances.distance(4)));
  distances.search(last, 2);
  EXPECT_TRUE(std::isinf(distances.distance(0)));
  EXPECT_EQ(distances.nearest_source(0), kNoIndex);
  EXPECT_DOUBLE_EQ(distances.distance(6), 2);
}

TEST(EdgeDistances, ForSomeVerticesAreThoseOfAWholeSearch) {
  constexpr std::uint32_t kSide = 24;
  Topology topology;
  topology.vertex_count = kSide * kSide;
  Positions positions(kSide * kSide, 3);
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {  // a sheet that is folded over at half its height
      const double height = std::abs(static_cast<double>(y) - 11.5);
      positions.row(y * kSide + x) << x + 0.3 * std::sin(y), height, 0.2 * std::cos(x * y);
      if (x + 1 == kSide || y + 1 == kSide) continue;
      const std::uint32_t v = y * kSide + x;
      topology.corner_vertices.insert(topology.corner_vertices.end(),
                                      {v, v + 1, v + kSide + 1, v + kSide});
      topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
    }
  }
  const Adjacency adjacency = build_adjacency(topology);
  EdgeDistances whole(adjacency, positions), some(adjacency, positions);
  std::size_t reached = 0, all = 0;
  for (const std::uint32_t source : {0U, 100U, 299U, 575U}) {
    for (const double limit : {2.0, 7.0, 20.0}) {
      const std::vector<std::uint32_t> goals = {300, 276, 12, 301, source};
      whole.search(std::span(&source, 1), limit);
      some.search_for(source, goals, limit);
      for (const std::uint32_t goal : goals) {
        EXPECT_EQ(some.distance(goal), whole.distance(goal))
            << source << ' ' << limit << ' ' << goal;
      }
      reached += some.reached().size();
      all += whole.reached().size();
    }
  }
  EXPECT_LT(reached, all);
  some.search_for(0, {}, 10);
  EXPECT_TRUE(some.reached().empty());
}

}  // namespace
}  // namespace crowdface
