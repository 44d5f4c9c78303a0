// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/joined_borders.h"

#include <array>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// A fan of four triangles around the vertex `first`, at the height z.
void add_fan(Topology& topology, Positions& positions, double z) {
  const auto first = static_cast<std::uint32_t>(topology.vertex_count);
  topology.vertex_count += 5;
  positions.conservativeResize(topology.vertex_count, 3);
  positions.bottomRows(5) << 0, 0, 0, 1, 0, z, 0, 1, z, -1, 0, z, 0, -1, z;
  for (std::uint32_t i = 0; i < 4; ++i) {
    topology.add_face(std::array{first, first + 1 + i, first + 1 + (i + 1) % 4});
  }
}

// Closed lips touch at inner vertices.
TEST(JoinedBorders, KeepsInnerVerticesThatTouchApart) {
  Topology topology;
  Positions positions;
  add_fan(topology, positions, 1);
  add_fan(topology, positions, -1);
  EXPECT_EQ(joined_borders(topology, positions).first_copy_of_joined_vertex.size(), 10U);
}

TEST(JoinedBorders, JoinsCopiesAtSeamsOfOnePiece) {
  Topology topology;
  topology.vertex_count = 6;
  Positions positions(6, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  topology.add_face(std::array{0U, 1U, 2U});
  topology.add_face(std::array{3U, 4U, 5U});
  const JoinedBorders by = joined_borders(topology, positions);
  EXPECT_EQ(by.joined_vertex_of_vertex, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(by.first_copy_of_joined_vertex, (std::vector<std::uint32_t>{0, 1, 2, 4}));
  EXPECT_EQ(
      joined_borders(topology, positions, {0, 0, 0, 1, 1, 1}).first_copy_of_joined_vertex.size(),
      6U);
}

}  // namespace
}  // namespace crowdface
