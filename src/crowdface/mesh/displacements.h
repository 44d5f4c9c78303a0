// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Displacements of some vertices of a mesh; all other vertices stay in place.
struct Displacements {
  std::vector<std::uint32_t> vertices;  ///< indices of the displaced vertices, ascending
  /// #vertices by 3: displacement of each vertex in `vertices`
  Positions moves;

  /// Adds the displacements to `positions`, #V by 3.

  void add_to(Positions& positions) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      positions.row(vertices[i]) += moves.row(static_cast<Index>(i));
    }
  }
};

}  // namespace crowdface
