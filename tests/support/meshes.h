// SPDX-License-Identifier: Apache-2.0
// Small meshes that tests of several modules use.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "crowdface/core/random.h"
#include "crowdface/mesh/topology.h"

namespace crowdface::testing {

inline Topology make_topology(Index vertices,
                              const std::vector<std::vector<std::uint32_t>>& faces) {
  Topology topology;
  topology.vertex_count = vertices;
  for (const auto& face : faces) {
    topology.corner_vertices.insert(topology.corner_vertices.end(), face.begin(), face.end());
    topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
  }
  return topology;
}

/// A sheet of columns by rows quads; vertex (x, y) is y·(columns + 1) + x. Its rim is open.
inline Topology grid_topology(std::uint32_t columns, std::uint32_t rows) {
  std::vector<std::vector<std::uint32_t>> faces;
  const std::uint32_t stride = columns + 1;
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const std::uint32_t a = y * stride + x;
      faces.push_back({a, a + 1, a + stride + 1, a + stride});
    }
  }
  return make_topology(static_cast<Index>(stride) * (rows + 1), faces);
}

/// A closed cube of 8 vertices and 6 quads, wound outwards.
inline Topology cube_topology() {
  return make_topology(
      8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}});
}
inline Positions cube_positions(double half = 1) {
  Positions p(8, 3);
  p << -1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1;
  return half * p;
}

/// Numbers in [−1, 1) that depend on the seed alone.
inline Positions random_positions(Index rows, std::uint64_t seed) {
  Positions positions(rows, 3);
  for (Index i = 0; i < rows; ++i) {
    for (Index c = 0; c < 3; ++c) {
      positions(i, c) =
          random_between({seed, static_cast<std::uint64_t>(i * 3 + c), "test/positions", 0}, -1, 1);
    }
  }
  return positions;
}

}  // namespace crowdface::testing
