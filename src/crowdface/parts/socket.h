// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {

/// The skin around a rigid part, or a point: what it moves with.
struct Socket {
  std::vector<std::uint32_t> vertices;  ///< ascending
  std::vector<double> weights;          ///< #vertices: area × nearness
};

/// Skin within `reach` of a part, on the head whose positions are given; what is nearer counts more,
/// by (1 − (d/reach)²)². Of many vertices some are chosen evenly.
/// \param part   the part's vertices
/// \param skin   the skin's vertices, ascending
/// \param areas  #V
Socket find_socket(const Positions& positions, const PointGrid& part,
                   std::span<const std::uint32_t> skin, const std::vector<double>& areas,
                   double reach);

}  // namespace crowdface
