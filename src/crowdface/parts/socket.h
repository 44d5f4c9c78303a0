// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {

/// The skin around a rigid part or a named point. The part or point follows the motion of this
/// skin.
struct Socket {
  std::vector<std::uint32_t> vertices;  ///< vertex indices of the skin, ascending
  /// for each vertex: its area times a weight that decreases with the distance from the part or
  /// point
  std::vector<double> weights;
};

/// Returns the skin within `reach` of a part on a head. Weights are area times (1 − (d/reach)²)²,
/// where d is the distance from the part. A large socket is subsampled evenly.
///
/// \param part   The part's vertices.
/// \param skin   The skin's vertices, ascending.
/// \param areas  Area of each vertex of the mesh.
Socket find_socket(const Positions& positions, const PointGrid& part,
                   std::span<const std::uint32_t> skin, const std::vector<double>& areas,
                   double reach);

}  // namespace crowdface
