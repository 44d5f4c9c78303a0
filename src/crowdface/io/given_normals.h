// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Vertices whose normals are given and not computed from the mesh.
struct GivenNormals {
  std::vector<std::uint32_t> vertices;
  Positions normals;  ///< #vertices by 3

  /// Writes the given normals into `all_normals`.
  /// \param all_normals  #V by 3
  void copy_to(Positions& all_normals) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      all_normals.row(vertices[i]) = normals.row(static_cast<Index>(i));
    }
  }
};

}  // namespace crowdface
