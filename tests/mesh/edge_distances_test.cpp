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
    EXPECT_EQ(distances.source(v), v <= 4 ? 0U : 1U) << "of equally near ones the first";
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
  EXPECT_EQ(distances.source(0), kNoIndex);
  EXPECT_DOUBLE_EQ(distances.distance(6), 2);
}

}  // namespace
}  // namespace crowdface
