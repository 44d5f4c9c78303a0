// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Openness from which skin counts as visible, and from which it lies open: not in folds.
inline constexpr double kSeen = 0.12, kOpenEnough = 0.3;

/// The skin of a template by itself, its vertices numbered anew.
struct SkinMesh {
  std::vector<std::uint32_t> vertices;  ///< rows of the template, ascending
  std::vector<Triangle> triangles;      ///< of rows of `vertices`
  Adjacency adjacency;                  ///< of the triangles
  std::vector<double> openness;  ///< #vertices, 0 … 1: how much of the outside each can see

  Index vertex_count() const { return static_cast<Index>(vertices.size()); }
  /// These rows of the template's positions.
  Positions of(const Positions& positions) const;
};

/// The share of rays from each vertex over the outer side that meet nothing: 0 inside mouth, nose and
/// eye sockets, near 1 on a forehead.
/// \param triangles  what stands in the way, the skin among it.
std::vector<double> vertex_openness(const Positions& positions, const Positions& normals,
                                    const std::vector<Triangle>& triangles,
                                    const std::vector<std::uint32_t>& vertices);

}  // namespace crowdface
