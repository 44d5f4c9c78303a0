// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Some vertices of a mesh, and unit normals for them that replace the normals computed from the
/// mesh. For example, the vertices at which head and body meet have common normals.
struct GivenNormals {
  std::vector<std::uint32_t> vertices;  ///< vertex indices in the mesh
  Positions normals;                    ///< #vertices by 3: the normal of each of the `vertices`

  /// Writes `normals` into the rows of `all_normals` that belong to `vertices`.
  /// \param all_normals  #V by 3: the normals of the whole mesh.
  void copy_to(Positions& all_normals) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      all_normals.row(vertices[i]) = normals.row(static_cast<Index>(i));
    }
  }
};

}  // namespace crowdface
