// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// A mesh of fewer triangles over some of the whole mesh's own vertices, for faces that are seen from
/// afar: one for a whole crowd, whose faces, and their shapes, are then rows of what they were.
struct DetailLevel {
  double share = 1;                     ///< of the whole mesh's triangles: what was asked for
  std::vector<std::uint32_t> vertices;  ///< rows of the whole mesh, ascending
  Topology topology;                    ///< triangles over `vertices`, with rows of `uvs`
  TextureCoordinates uvs;               ///< #T by 2, the whole mesh's own; may be empty
  std::vector<std::uint32_t>
      faces;  ///< of each triangle, a face of the whole mesh that looks alike

  /// What a mesh, or displacements of its vertices, are on this level. \param whole  #V by 3.
  Positions of(const Positions& whole) const;
  Displacements of(const Displacements& whole) const;
};

/// How far vertices of the whole mesh are from the surface of a level.
struct LevelError {
  double most = 0;
  double root_mean_square = 0;
};

/// Levels by edge collapse on the mean head (quadric error metrics, Garland & Heckbert 1997, by
/// meshoptimizer), each from the whole mesh. Open rims, seams of the texture and the borders of
/// looks keep their course.
/// \param looks   #F, of each face: what it looks like, by number; triangles of one look stay together.
///                Tiles of the texture are told apart beside.
/// \param shares  of the triangles, each in (0, 1). Where borders need more there are more.
/// \return        #shares
std::vector<DetailLevel> detail_levels(const FaceSet& faces, std::span<const std::uint32_t> looks,
                                       std::span<const double> shares);

}  // namespace crowdface
