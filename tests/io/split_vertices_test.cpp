// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/split_vertices.h"

#include <set>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(SplitVertices, WithoutTextureCoordinatesAreTheVertices) {
  const SplitVertices split =
      split_vertices(testing::make_topology(7, {{0, 1, 2}, {2, 1, 3, 4}, {4, 3, 5, 0, 1}}));
  EXPECT_EQ(split.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(split.uvs.empty());
  EXPECT_EQ(split.triangles,
            (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {4, 5, 0}, {4, 0, 1}}));
  EXPECT_EQ(split.triangle_faces, (std::vector<std::uint32_t>{0, 1, 1, 2, 2, 2}));
}

TEST(SplitVertices, OpenAtSeamsOnly) {
  Topology topology = testing::make_topology(4, {{0, 1, 2}, {2, 1, 3}, {3, 1, 0}});
  topology.corner_uvs = {10, 11, 12, 12, 21, 13, 13, 21, kNoIndex};
  const SplitVertices split = split_vertices(topology);
  EXPECT_EQ(split.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 0}));
  EXPECT_EQ(split.uvs, (std::vector<std::uint32_t>{10, 11, 12, 13, 21, kNoIndex}));
  EXPECT_EQ(split.triangles, (Triangles{{0, 1, 2}, {2, 4, 3}, {3, 4, 5}}));
}

TEST(SplitVertices, GiveEveryCornerItsVertexAndTextureCoordinate) {
  Topology grid = testing::grid_topology(40, 30);
  for (std::size_t c = 0; c < grid.corner_vertices.size(); ++c) {
    grid.corner_uvs.push_back(static_cast<std::uint32_t>((c * 2654435761U) >> 7U) % 3000);
  }
  const SplitVertices split = split_vertices(grid);
  std::set<std::pair<std::uint32_t, std::uint32_t>> expected, found;
  for (std::size_t c = 0; c < grid.corner_vertices.size(); ++c) {
    expected.emplace(grid.corner_vertices[c], grid.corner_uvs[c]);
  }
  for (std::size_t s = 0; s < split.vertices.size(); ++s) {
    found.emplace(split.vertices[s], split.uvs[s]);
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(split.vertices.size(), expected.size()) << "none twice";
  for (std::size_t f = 0; f < 1200; ++f) {
    const std::uint32_t ends[] = {0, 1, 2, 0, 2, 3};
    for (std::size_t k = 0; k < 6; ++k) {
      const std::uint32_t corner = split.triangles[2 * f + k / 3][k % 3];
      const std::size_t c = 4 * f + ends[k];
      EXPECT_EQ(split.vertices[corner], grid.corner_vertices[c]);
      EXPECT_EQ(split.uvs[corner], grid.corner_uvs[c]);
    }
  }
}

}  // namespace
}  // namespace crowdface
