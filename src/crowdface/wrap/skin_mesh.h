// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Thresholds of ambient visibility, see vertex_ambient_visibility. Skin above
/// kVisibleSkinThreshold counts as visible; skin above kUnfoldedSkinThreshold also counts as
/// outside folds.
inline constexpr double kVisibleSkinThreshold = 0.12, kUnfoldedSkinThreshold = 0.3;

/// The skin of a template as a separate mesh with its own vertex indices.
struct SkinMesh {
  std::vector<std::uint32_t> vertices;  ///< vertex indices in the template, ascending
  /// Triangles of the skin; their corners are indices into `vertices`.
  std::vector<Triangle> triangles;
  Adjacency adjacency;  ///< for each vertex of the skin, its neighbours along edges
  /// #vertices, 0 … 1: see `vertex_ambient_visibility`
  std::vector<double> ambient_visibility;

  Index vertex_count() const { return static_cast<Index>(vertices.size()); }
  /// Returns the rows of `positions` (of the whole template) that belong to the skin.
  Positions rows_of(const Positions& positions) const;
};

/// Returns, for each vertex, its ambient visibility (1 − ambient occlusion): the fraction of rays
/// into its outer hemisphere that hit nothing. 0 inside mouth, nose and eye sockets, near 1 on a
/// forehead.
/// \param triangles  occluders, including the skin.
std::vector<double> vertex_ambient_visibility(const Positions& positions, const Positions& normals,
                                              const std::vector<Triangle>& triangles,
                                              const std::vector<std::uint32_t>& vertices);

}  // namespace crowdface
