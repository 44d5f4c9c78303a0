// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Whether simplification may remove vertices on the open borders of a mesh.
enum class Borders { kCollapse, kKeep };

/// Collapses edges in order of increasing error, until at most `max_triangles` triangles are left
/// (quadric error metrics, Garland & Heckbert 1997, by meshoptimizer). Edges of open borders, and
/// of seams (borders where several vertices have the same position), collapse only along the
/// border. If these constraints block further collapses, more than `max_triangles` triangles
/// remain.
/// \param positions  #V by 3, finite.
/// \param borders    whether vertices of open borders may be removed.
std::vector<Triangle> reduce_triangles(const std::vector<Triangle>& triangles,
                                       const Positions& positions, std::size_t max_triangles,
                                       Borders borders = Borders::kCollapse);

/// A reduced mesh. Its vertices are a subset of the vertices of the whole mesh, numbered in the
/// order in which the triangles first use them.
struct ReducedMesh {
  /// indices, in the whole mesh, of the vertices that the reduced mesh keeps; no index occurs twice
  std::vector<std::uint32_t> vertices;
  std::vector<Triangle> triangles;  ///< indices into `vertices`
};

/// Like reduce_triangles, but also drops unused vertices and renumbers the other vertices.
/// \param max_triangles  maximum number of triangles.
ReducedMesh reduce_mesh(const std::vector<Triangle>& triangles, const Positions& positions,
                        std::size_t max_triangles);

/// Like reduce_triangles, but with a separate limit for hidden triangles. Edges on the border
/// between visible and hidden triangles do not collapse, so that no gap opens at this border.
/// \param hidden         for each triangle, whether it is hidden.
/// \param max_triangles  maximum number of all triangles together.
/// \param max_hidden     maximum number of hidden triangles.
std::vector<Triangle> reduce_hidden(const std::vector<Triangle>& triangles,
                                    const Positions& positions, const std::vector<bool>& hidden,
                                    std::size_t max_triangles, std::size_t max_hidden);

}  // namespace crowdface
