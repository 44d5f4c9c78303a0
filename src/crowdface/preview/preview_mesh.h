// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/preview/split_mesh.h"

namespace crowdface {

/// A reduced mesh whose vertices are split where its texture or its look changes: what a graphics card draws.
struct PreviewMesh {
  std::vector<std::uint32_t> vertices;   ///< rows of the whole mesh
  std::vector<std::uint32_t> twins;      ///< #vertices: the first vertex at the same row
  std::vector<std::uint32_t> triangles;  ///< three of `vertices` each, one look after the other
  std::vector<float> uvs;                ///< two a vertex, or empty: there are none
  std::vector<std::uint32_t> faces;      ///< #vertices: a face of the whole mesh that has it so
  std::vector<std::uint32_t> looks;      ///< the first triangle of each look that is left
};

/// \param uvs            #uvs by 2 where the faces have texture coordinates: those to be shown
/// \param typical        #V by 3, by which is judged what may go
/// \param drawn          one a face, or empty: all
/// \param most_vertices  about how many may be left before splitting
PreviewMesh preview_mesh(const Topology& topology, const TextureCoordinates& uvs,
                         const Positions& typical, const std::vector<bool>& drawn,
                         std::size_t most_vertices);

/// The same of triangles that are reduced already.
/// \param triangles  of corners of `split`
/// \param uvs        that it was split by
PreviewMesh preview_of(const SplitMesh& split, std::vector<Triangle> triangles,
                       const TextureCoordinates& uvs);

}  // namespace crowdface
