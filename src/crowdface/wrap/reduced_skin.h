// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// A skin mesh with fewer vertices, which replaces a skin with many vertices during deformation.
struct ReducedSkin {
  SkinMesh mesh;  ///< the reduced mesh; its `vertices` are vertex indices in the original skin
  /// Position of a vertex of the original skin on the reduced skin: triangle and barycentric
  /// coordinates.
  struct BarycentricPoint {
    std::uint32_t triangle;            ///< index of a triangle of the reduced skin
    std::array<float, 3> barycentric;  ///< barycentric coordinates of the position in this triangle
  };
  /// For each vertex of the original skin, its position on `mesh`.
  std::vector<BarycentricPoint> vertex_positions;
  int smoothing_steps = 0;  ///< number of smoothing steps after interpolation

  /// Interpolates values at the reduced skin's vertices (one row of three each) to the vertices of
  /// the original skin, and smooths them so that the edges of the reduced skin do not become
  /// visible.
  Positions interpolate(const Positions& values, const SkinMesh& original) const;
  /// Interpolates one value per vertex of the reduced skin to the vertices of the original skin,
  /// without smoothing.
  std::vector<double> interpolate(const std::vector<double>& values) const;
};

/// Reduces a skin to a subset of about `vertex_count` of its vertices.
/// \param positions  #skin by 3
ReducedSkin reduce_skin(const SkinMesh& skin, const Positions& positions, std::size_t vertex_count);

}  // namespace crowdface
