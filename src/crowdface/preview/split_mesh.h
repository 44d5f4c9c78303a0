// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A triangulated mesh for edge collapses (reduced_mesh.h). Vertices at texture seams and at
/// borders between materials are split into several corners, so that edge collapses preserve these
/// borders.
struct SplitMesh {
  /// A vertex with one of its texture coordinates and one of its materials.
  struct Corner {
    /// `vertex`: row of the position. `uv`: row of the texture coordinate, or kNoIndex. `material`:
    /// index of the material.
    std::uint32_t vertex, uv, material;
    auto operator<=>(const Corner&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Corner> corners;  ///< distinct corners, sorted by (vertex, uv, material)
  /// for each corner, the first of the polygons that share the corner
  std::vector<std::uint32_t> face_of_corner;
  std::vector<Triangle> triangles;  ///< indices into `corners`
  /// for each material: the first polygon with this material
  std::vector<std::uint32_t> first_face_of_material;

  /// Returns the positions of the corners, #corners by 3.
  /// \param whole  positions of the whole mesh, #V by 3.
  Positions corner_positions(const Positions& whole) const;
};

/// Splits the vertices of a mesh. Polygons with equal labels but in different texture tiles get
/// different materials.
/// \param uvs    texture coordinates; may be empty.
/// \param materials  for each polygon: the label of the material; kNoIndex omits the polygon.
SplitMesh split_mesh(const Topology& topology, const TextureCoordinates& uvs,
                     std::span<const std::uint32_t> materials);

/// Groups triangles of the split mesh by material. Drops each triangle of which two corners are the
/// same vertex; edge collapses along seams make such triangles.
std::vector<Triangle> grouped_by_material(std::vector<Triangle> triangles, const SplitMesh& split);

}  // namespace crowdface
