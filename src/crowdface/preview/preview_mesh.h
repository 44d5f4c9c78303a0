// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A reduced mesh whose vertices are split where texture coordinates are: what a graphics card draws.
struct PreviewMesh {
  std::vector<std::uint32_t> vertices;   ///< rows of the whole mesh
  std::vector<std::uint32_t> twins;      ///< #vertices: the first vertex at the same row
  std::vector<std::uint32_t> triangles;  ///< three of `vertices` each
  std::vector<float> uvs;                ///< two a vertex, or empty: the heads have none
};

/// \param uvs            #uvs by 2 where the faces have texture coordinates: those to be shown
/// \param typical        #V by 3, by which is judged what may go
/// \param drawn          one a face; see reduce_mesh
/// \param most_vertices  about how many may be left before splitting
PreviewMesh preview_mesh(const Topology& topology, const TextureCoordinates& uvs,
                         const Positions& typical, const std::vector<bool>& drawn,
                         std::size_t most_vertices);

}  // namespace crowdface
