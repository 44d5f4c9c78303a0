// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Which faces meet at each row of normals (a vertex, or a `vn` of a file), found once for all
/// meshes of a topology: so that each row can be summed by itself, in parallel, and always in the
/// same order.
class NormalFans {
 public:
  /// One row a vertex.
  explicit NormalFans(const Topology& topology);
  /// \param corner_rows  #C, the row that each corner belongs to, < rows, or kNoIndex.
  NormalFans(const Topology& topology, std::span<const std::uint32_t> corner_rows, Index rows);

  /// #rows by 3 unit normals: the sum of the normals of the faces around, in ascending order, each
  /// weighted by its area (Newell's method for polygons, so quads need not be flat).
  /// \param topology  the one the fans were made for.
  /// \param nowhere   what stands where the sum vanishes.
  Positions normals(const Topology& topology, const Positions& positions,
                    const Eigen::RowVector3d& nowhere) const;
  /// The same from what face_area_vectors gives.
  Positions normals(const Positions& areas, const Eigen::RowVector3d& nowhere) const;

  Index rows() const { return static_cast<Index>(faces_.group_count()); }
  /// The faces around one row, ascending.
  std::span<const std::uint32_t> around(Index row) const { return faces_.of(row); }
  std::size_t memory_bytes() const {
    return (faces_.offsets.size() + faces_.items.size()) * sizeof(std::uint32_t);
  }

 private:
  Grouped<std::uint32_t> faces_;  ///< around each row, ascending
};

/// #V by 3 unit normals of the vertices, as NormalFans gives them; (0, 0, 1) where the sum
/// vanishes. Whoever needs them for many meshes of one topology keeps the fans.
Positions vertex_normals(const Topology& topology, const Positions& positions);
Positions vertex_normals(const NormalFans& fans, const Topology& topology,
                         const Positions& positions);

/// Twice the vector area of one face (Newell's method): its direction is the face's normal, its
/// length twice the face's area if the face is flat.
Eigen::Vector3d face_area_vector(const Topology& topology, Index face, const Positions& positions);

/// #F by 3, the same for all faces, in parallel.
Positions face_area_vectors(const Topology& topology, const Positions& positions);

}  // namespace crowdface
