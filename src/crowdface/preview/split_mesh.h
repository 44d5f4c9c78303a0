// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A triangulated mesh whose vertices are split at texture seams and at borders between materials,
/// so that edge collapses (reduced_mesh.h) preserve these borders.
struct SplitMesh {
  struct Corner {
    /// vertex: row of positions; uv: row of texture coordinates, or kNoIndex; material: index of
    /// the material.
    std::uint32_t vertex, uv, material;
    auto operator<=>(const Corner&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Corner> corners;                  ///< distinct corners, ascending
  std::vector<std::uint32_t> face_of_corner;    ///< #corners: the first face with this corner
  std::vector<Triangle> triangles;              ///< indices into `corners`
  std::vector<std::uint32_t> face_of_material;  ///< #materials: the first face of each material

  /// Returns the positions of the corners, #corners by 3.
  /// \param whole  positions of the whole mesh, #V by 3.
  Positions corner_positions(const Positions& whole) const;
};

/// Splits a mesh. Faces with the same label but in different texture tiles get different materials.
/// \param uvs    may be empty.
/// \param materials  #F: the material label of each face; kNoIndex omits the face.
SplitMesh split_mesh(const Topology& topology, const TextureCoordinates& uvs,
                     std::span<const std::uint32_t> materials);

/// Groups triangles of the split mesh by material. Drops triangles with two equal vertices, which
/// result from edge collapses along seams.
std::vector<Triangle> grouped_by_material(std::vector<Triangle> triangles, const SplitMesh& split);

}  // namespace crowdface
