// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {

/// A level of detail: a mesh with fewer triangles, whose vertices are a subset of the whole mesh's
/// vertices. At each level, all faces of a crowd have the same topology, so a face or a shape at
/// this level is a selection of rows of the whole face or shape.
struct DetailLevel {
  double share = 1;  ///< requested number of triangles, as a fraction of the whole mesh's triangles
  /// indices of the level's vertices in the whole mesh, ascending
  std::vector<std::uint32_t> vertices;
  /// triangles; vertex v of the level is vertex `vertices[v]` of the whole mesh
  Topology topology;
  /// a subset of the rows of the whole mesh's texture coordinates; may be empty
  TextureCoordinates uvs;
  /// for each triangle, a polygon of the whole mesh that has the same material
  std::vector<std::uint32_t> source_faces;

  /// Returns the rows of the whole mesh's positions or displacements that belong to this level.
  ///
  /// \param whole  #V by 3.
  Positions restrict_rows(const Positions& whole) const;
  /// Returns the displacements of the level's vertices.
  Displacements restrict_rows(const Displacements& whole) const;
};

/// Statistics of the distances from the vertices of the whole mesh to the surface of a level, in
/// the unit of the positions.
struct LevelError {
  double max = 0;  ///< largest distance from a vertex of the whole mesh to the level's surface
  /// root mean square distance from the vertices of the whole mesh to the level's surface
  double root_mean_square = 0;
};

/// Makes levels of detail by edge collapse on the mean head (quadric error metrics, Garland &
/// Heckbert 1997, with meshoptimizer). Each level is made directly from the whole mesh. Open
/// borders, texture seams and borders between materials are preserved. Here, a material is a pair
/// of a material label and a texture tile.
///
/// \param materials  the material label of each polygon; kNoIndex omits the polygon. The triangles
///                   of one material are contiguous in the result.
/// \param shares     requested fractions of the triangles, each in (0, 1). A level has more
///                   triangles than requested if its borders need more.
/// \param borders    how edge collapse treats the vertices of open borders.
/// \return           one level for each entry of `shares`.
std::vector<DetailLevel> detail_levels(const HeadSet& heads,
                                       std::span<const std::uint32_t> materials,
                                       std::span<const double> shares,
                                       Borders borders = Borders::kCollapse);

}  // namespace crowdface
