// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {

/// A level of detail: fewer triangles over a subset of the whole mesh's vertices. All faces of a
/// crowd share one level's topology, so a face or shape at this level consists of some rows of the
/// whole face or shape.
struct DetailLevel {
  double share = 1;                     ///< requested fraction of the whole mesh's triangles
  std::vector<std::uint32_t> vertices;  ///< vertices of the whole mesh, ascending
  Topology topology;                    ///< triangles over `vertices` and rows of `uvs`
  TextureCoordinates uvs;               ///< #T by 2, a subset of the whole mesh's; may be empty
  std::vector<std::uint32_t>
      faces;  ///< #triangles: a face of the whole mesh with the same material as the triangle

  /// Restricts positions or displacements of the whole mesh to this level.
  /// \param whole  #V by 3.
  Positions restrict_rows(const Positions& whole) const;
  Displacements restrict_rows(const Displacements& whole) const;
};

/// Statistics of the distances between the vertices of the whole mesh and the surface of a level.
struct LevelError {
  double max = 0;
  double root_mean_square = 0;
};

/// Makes levels by edge collapse on the mean head, each level directly from the whole mesh (quadric
/// error metrics, Garland & Heckbert 1997, with meshoptimizer). Open borders, texture seams and
/// borders between materials are preserved. Here, a material is a pair of a material label and a
/// texture tile.
/// \param materials  #F: the material label of each face; kNoIndex omits the face. Triangles of one
///                   material are contiguous.
/// \param shares     fractions of the triangles, each in (0, 1). A level has more triangles if its
///                   borders need them.
/// \param borders    how edge collapse treats the vertices of open borders.
/// \return           #shares levels.
std::vector<DetailLevel> detail_levels(const HeadSet& heads,
                                       std::span<const std::uint32_t> materials,
                                       std::span<const double> shares,
                                       Borders borders = Borders::kCollapse);

}  // namespace crowdface
