// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// A surface as a scanner or another program left it: any unit, any pose, any triangles.
struct Scan {
  Positions positions;              ///< #V by 3
  std::vector<Triangle> triangles;  ///< wound so that they look outwards
};

/// Every polygon as a fan around its first corner.
std::vector<Triangle> triangles_of(const Topology& topology);

/// Triangles as faces.
Topology topology_of(const std::vector<Triangle>& triangles, Index vertex_count);

/// Unit normals of the vertices, each the sum of the normals around it weighted by area; zero where
/// none is.
Positions scan_normals(const Scan& scan);

/// #V: whether a vertex lies on an edge that has exactly one triangle: a hole, or where the scan ends.
std::vector<bool> rim_vertices(const std::vector<Triangle>& triangles, Index vertex_count);

/// The vertices of rims that are at least this long, ascending: where a surface ends.
std::vector<std::uint32_t> long_rims(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double least_length);

/// The scan without pieces of less than this share of the largest one's area, and without triangles
/// that name a vertex twice. Vertices stay, so that their numbers do.
Scan without_small_pieces(const Scan& scan, double least_share);

/// One vertex for all that stand in one place: STL files repeat each corner, others do along the
/// borders of textures. The first of each place is kept; the others lose their triangles to it.
void weld(Scan& scan);

}  // namespace crowdface
