// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Displacements of some vertices of a mesh; all other vertices stay in place.
struct Displacements {
  std::vector<std::uint32_t> vertices;  ///< the displaced vertices, ascending
  Positions moves;                      ///< displacement of each of these vertices, #vertices by 3

  /// \param positions  #V by 3
  void add_to(Positions& positions) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      positions.row(vertices[i]) += moves.row(static_cast<Index>(i));
    }
  }
};

}  // namespace crowdface
