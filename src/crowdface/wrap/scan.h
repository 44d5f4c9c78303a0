// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A surface from a scanner or another program, in any unit and pose, with any triangulation.
struct Scan {
  Positions positions;              ///< #V by 3
  std::vector<Triangle> triangles;  ///< the corners are ordered so that the normals point outwards
  /// Repairs of the scan, and omitted content, one sentence each.
  std::vector<std::string> notes = {};
  /// for each triangle: its index among all triangles into which `triangles_of` divides the file's
  /// polygons; empty if the scan does not come from a file
  std::vector<std::uint32_t> file_triangle_indices = {};
};

/// Removes the triangles for which `is_kept` is false.
/// \param is_kept  called with the index of each triangle, in ascending order.
void keep_triangles(Scan& scan, const std::function<bool(std::size_t)>& is_kept);

/// For each vertex: whether a triangle uses the vertex.
std::vector<bool> is_vertex_used(const Scan& scan);

/// How far a surface is from being closed: the length of the sum of the triangles' area vectors,
/// divided by the sum of their areas. 0 for a closed surface, less than 0.2 for a head with its
/// neck, about 0.5 for half a head, 0.8 for a face alone.
double net_area_fraction(const Scan& scan);

/// Returns the vertices, ascending, of all boundary loops that are at least `min_length` long.
std::vector<std::uint32_t> long_boundaries(const std::vector<Triangle>& triangles,
                                           const Positions& positions, double min_length);

/// Removes connected components with less than `min_share` of the largest component's area, and
/// triangles with a repeated vertex. Keeps all vertices, so that vertex indices do not change.
Scan remove_small_pieces(const Scan& scan, double min_share);

/// If the scan is a modelled head with eyeballs, removes the thin layers that lie in front of skin
/// and eyes: lashes, tear lines, shadow shells. Returns other scans unchanged.
Scan remove_covering_layers(const Scan& scan);
/// If the scan is a modelled head with eyeballs, keeps only the skin. Returns other scans
/// unchanged.
Scan keep_skin(const Scan& scan);

/// Merges vertices with equal positions: STL files repeat every corner, other formats repeat
/// vertices at texture seams. Triangles then refer to the first vertex at each position. If merging
/// hardly enlarges the largest connected component, leaves the scan unchanged: the mesh was already
/// connected, and lashes and eyes that touch the skin stay separate.
void weld_vertices(Scan& scan);

}  // namespace crowdface
