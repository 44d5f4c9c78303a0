// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A mesh as triangles whose vertices are split wherever its texture or its look changes, so that edge
/// collapses (reduced_mesh.h) keep the course of such seams.
struct SplitMesh {
  struct Corner {
    std::uint32_t vertex, uv, look;  ///< rows of positions and of texture coordinates (or kNoIndex)
    auto operator<=>(const Corner&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Corner> corners;                ///< each once, ascending
  std::vector<std::uint32_t> face_of_corner;  ///< #corners, the first face that has it
  std::vector<Triangle> triangles;            ///< of corners
  std::vector<std::uint32_t> face_of_look;    ///< the first face of each

  /// \param whole  #V by 3. \return #corners by 3
  Positions of(const Positions& whole) const;
};

/// \param uvs    may be empty.
/// \param looks  #F, of each face: what it looks like, by number; of kNoIndex: the face is left out. Tiles of
///               the texture are told apart beside.
SplitMesh split_mesh(const Topology& topology, const TextureCoordinates& uvs,
                     std::span<const std::uint32_t> looks);

/// Triangles of the split mesh, one look after the other, without those that have one vertex twice: a seam
/// collapsed between them.
std::vector<Triangle> in_order_of_looks(std::vector<Triangle> triangles, const SplitMesh& split);

}  // namespace crowdface
