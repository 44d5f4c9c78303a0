// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/adjacency.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::cube_topology;
using testing::grid_topology;
using testing::make_topology;

std::vector<std::uint32_t> ring(const Adjacency& adjacency, Index i) {
  const auto neighbours = adjacency.items_of(i);
  return {neighbours.begin(), neighbours.end()};
}

TEST(Adjacency, OfAQuadHasEdgesButNoDiagonals) {
  const Adjacency adjacency = build_adjacency(make_topology(4, {{0, 1, 2, 3}}));
  EXPECT_EQ(ring(adjacency, 0), (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(ring(adjacency, 2), (std::vector<std::uint32_t>{1, 3}));
}

TEST(Adjacency, MatchesASlowSetOfEdges) {
  const Topology topology =
      make_topology(9, {{0, 1, 2}, {2, 1, 3, 4}, {4, 3, 5, 6, 7}, {7, 0, 2, 4}});
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      edges.insert({face[c], face[(c + 1) % face.size()]});
      edges.insert({face[(c + 1) % face.size()], face[c]});
    }
  }
  const Adjacency adjacency = build_adjacency(topology);
  for (std::uint32_t i = 0; i < 9; ++i) {
    std::vector<std::uint32_t> expected;
    for (const auto& [a, b] : edges) {
      if (a == i) expected.push_back(b);
    }
    EXPECT_EQ(ring(adjacency, i), expected) << i;
  }
  EXPECT_TRUE(ring(adjacency, 8).empty());
}

TEST(Adjacency, OnlyEdgesWithOneFaceAreOpen) {
  const Adjacency cube = build_adjacency(cube_topology());
  EXPECT_EQ(std::count(cube.boundary.begin(), cube.boundary.end(), true), 0);
  const Adjacency grid = build_adjacency(grid_topology(4, 3));
  EXPECT_EQ(std::count(grid.boundary.begin(), grid.boundary.end(), true), 14);
  EXPECT_FALSE(grid.boundary[6]);  // (1, 1)
  // Three faces at one edge: not manifold, not open there.
  const Adjacency fan = build_adjacency(make_topology(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(ring(fan, 0), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_TRUE(fan.boundary[0]);  // by its other edges
}

TEST(Adjacency, IgnoresEdgesFromAVertexToItself) {
  const Adjacency adjacency = build_adjacency(make_topology(3, {{0, 0, 1, 2}}));
  EXPECT_EQ(ring(adjacency, 0), (std::vector<std::uint32_t>{1, 2}));
}

TEST(Components, AreJoinedByEdges) {
  const Topology topology = make_topology(8, {{0, 1, 2}, {4, 5, 6, 7}});
  const Components components = find_components(build_adjacency(topology));
  EXPECT_EQ(components.component_of_vertex, (std::vector<std::uint32_t>{0, 0, 0, 1, 2, 2, 2, 2}));
  EXPECT_EQ(components.sizes, (std::vector<std::uint32_t>{3, 1, 4}));
  EXPECT_EQ(components.largest(), 2U);
}

TEST(RmsEdgeLength, CountsEachEdgeOnceAndOnlyItsComponent) {
  const Topology topology = make_topology(7, {{0, 1, 2, 3}, {4, 5, 6}});
  Positions positions = Positions::Zero(7, 3);
  positions.topRows(4) << 0, 0, 0, 3, 0, 0, 3, 1, 0, 0, 1, 0;  // edges of 3, 1, 3, 1
  positions.bottomRows(3).setRandom();
  const Adjacency adjacency = build_adjacency(topology);
  const Components components = find_components(adjacency);
  EXPECT_DOUBLE_EQ(rms_edge_length(adjacency, components, 0, positions), std::sqrt(5.0));
}

}  // namespace
}  // namespace crowdface
