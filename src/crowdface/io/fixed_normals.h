// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Vertices with given normals, which are not computed from the mesh.
struct FixedNormals {
  std::vector<std::uint32_t> vertices;
  Positions normals;  ///< #vertices by 3

  /// Writes the given normals into `all`.
  /// \param all  #V by 3
  void set(Positions& all) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      all.row(vertices[i]) = normals.row(static_cast<Index>(i));
    }
  }
};

}  // namespace crowdface
