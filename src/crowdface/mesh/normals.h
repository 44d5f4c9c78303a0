// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// For each normal (of a vertex, or of a `vn` line of an OBJ file), the list of the polygons whose
/// normals are summed to compute it. The lists are computed once for all meshes of a topology. With
/// these lists, threads compute normals independently, and each sum has the same order in every
/// run.
class NormalFans {
 public:
  /// Makes the lists of polygons for the case that each vertex has one normal.
  explicit NormalFans(const Topology& topology);
  /// \param normal_of_corner  #C: index of the normal that each corner uses, or kNoIndex.
  /// \param count             number of normals.
  NormalFans(const Topology& topology, std::span<const std::uint32_t> normal_of_corner,
             Index count);

  /// Unit normals, #normals by 3. Each unit normal is the normalised, area-weighted sum of the
  /// normals of the polygons in its list, added in ascending order of polygon number. Polygons need
  /// not be flat (Newell's method).
  /// \param topology  the topology from which this object was made.
  /// \param fallback  the unit normal if the sum is zero.
  Positions normals(const Topology& topology, const Positions& positions,
                    const Eigen::RowVector3d& fallback) const;
  /// Computes the unit normals like the other overload, from the area vectors of all polygons.
  /// \param areas  result of face_area_vectors.
  Positions normals(const Positions& areas, const Eigen::RowVector3d& fallback) const;

  /// Number of normals.
  Index rows() const { return static_cast<Index>(polygons_of_normal_.group_count()); }
  /// The polygons whose normals are summed for the normal with index `row`, ascending.
  std::span<const std::uint32_t> polygons_at(Index row) const {
    return polygons_of_normal_.items_of(row);
  }
  std::size_t memory_bytes() const {
    return (polygons_of_normal_.offsets.size() + polygons_of_normal_.items.size()) *
           sizeof(std::uint32_t);
  }

 private:
  CompressedRows<std::uint32_t> polygons_of_normal_;  ///< the polygons of each normal, ascending
};

/// Unit normals of the vertices, #V by 3: the normalised, area-weighted sums of polygon normals
/// (see NormalFans); (0, 0, 1) where the sum vanishes. For many meshes of one topology, making one
/// NormalFans and calling NormalFans::normals is faster.
Positions vertex_normals(const Topology& topology, const Positions& positions);
/// Computes the unit normals of the vertices like the other overload, with a NormalFans that the
/// caller has already made. \param fans  made from `topology`
Positions vertex_normals(const NormalFans& fans, const Topology& topology,
                         const Positions& positions);

/// Twice the vector area of one polygon (Newell's method). The vector points along the normal of
/// the polygon; if the polygon is flat, the vector's length is twice the area.
Eigen::Vector3d face_area_vector(const Topology& topology, Index face, const Positions& positions);

/// The area vectors of all polygons, #F by 3, computed in parallel.
Positions face_area_vectors(const Topology& topology, const Positions& positions);

}  // namespace crowdface
