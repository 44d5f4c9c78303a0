// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface::multiscale {

/// The front of a head as one connected surface, with its own vertex numbers. Its longest boundary
/// loop (rim) is the border; every other rim is the rim of a hole, such as an eye.
struct FrontPatch {
  std::vector<std::uint32_t> head_vertices;  ///< the head vertex of each patch vertex
  std::vector<Triangle> triangles;           ///< indices of patch vertices
  std::vector<std::uint32_t> border;         ///< patch vertices around the border, in order
  std::vector<std::vector<std::uint32_t>> hole_rims;  ///< patch vertices around each hole, in order
  /// Indices into `border`, ascending: the vertices that become the corners of the unit square.
  std::array<std::size_t, 4> corners_in_border{};

  Index vertex_count() const { return static_cast<Index>(head_vertices.size()); }
  /// Selects the rows of the patch's vertices from an array with one row for each vertex of the
  /// head.
  Positions rows_of(const Positions& head) const;
};

/// Selects the skin in the front half of the head (ComparedArea::kFront) whose normals point
/// forwards. Eye sockets and the inside of the mouth become holes. Omits triangles where a rim
/// touches itself and triangles whose corners all lie on rims.
/// \param mean   #V by 3, the mean of all heads.
/// \param up     axis towards the top of the head.
/// \param front  axis that points to the front of the head.
/// \throws InvalidInput if the front has no border.
FrontPatch front_patch(const Topology& topology, const Positions& mean, Axis up, Axis front);

}  // namespace crowdface::multiscale
