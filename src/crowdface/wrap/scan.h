// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A surface as a scanner or another program left it: any unit, any pose, any triangles.
struct Scan {
  Positions positions;                  ///< #V by 3
  std::vector<Triangle> triangles;      ///< wound so that they look outwards
  std::vector<std::string> notes = {};  ///< what was mended or left out, a sentence each
};

/// #V: whether a triangle has the vertex.
std::vector<bool> used_vertices(const Scan& scan);

/// The vertices of rims that are at least this long, ascending: where a surface ends.
std::vector<std::uint32_t> long_rims(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double least_length);

/// The scan without pieces of less than this share of the largest one's area, and without triangles
/// that name a vertex twice. Vertices stay, so that their numbers do.
Scan without_small_pieces(const Scan& scan, double least_share);

/// Of a modelled head, one with eyeballs, without what lies over skin and eyes: lashes, tear lines, shells for shadows.
/// Other scans as they are.
Scan without_shells(const Scan& scan);

/// One vertex for all that stand in one place: STL files repeat each corner, others do along the
/// borders of textures. The first of each place is kept; the others lose their triangles to it. A surface that hangs
/// together without that stays as it is: lashes and eyes that touch its vertices are none of it.
void weld(Scan& scan);

}  // namespace crowdface
