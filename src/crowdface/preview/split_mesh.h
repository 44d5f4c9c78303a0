// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A triangulated mesh whose vertices are split at texture seams and at borders between looks, so
/// that edge collapses (reduced_mesh.h) preserve these borders. A look is a material label.
struct SplitMesh {
  struct Corner {
    /// vertex: row of positions; uv: row of texture coordinates, or kNoIndex; look: number of the
    /// look.
    std::uint32_t vertex, uv, look;
    auto operator<=>(const Corner&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Corner> corners;                  ///< distinct corners, ascending
  std::vector<std::uint32_t> face_of_corner;    ///< #corners: the first face with this corner
  std::vector<Triangle> triangles;              ///< indices into `corners`
  std::vector<std::uint32_t> face_of_material;  ///< #looks: the first face of each look

  /// The positions of the corners.
  /// \param whole  #V by 3.
  /// \return       #corners by 3.
  Positions of(const Positions& whole) const;
};

/// Splits a mesh. Faces with one label but in different texture tiles become different looks.
/// \param uvs    may be empty.
/// \param looks  #F: the material label of each face; kNoIndex omits the face.
SplitMesh split_mesh(const Topology& topology, const TextureCoordinates& uvs,
                     std::span<const std::uint32_t> looks);

/// Groups triangles of the split mesh by look. Drops triangles with two equal vertices, which
/// result from edge collapses along seams.
std::vector<Triangle> grouped_by_material(std::vector<Triangle> triangles, const SplitMesh& split);

}  // namespace crowdface
