// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Geodesic distances on a mesh: the path from lip to lip leads around the corner of the mouth.
/// Components whose boundaries coincide vertex by vertex count as one surface, because a face and
/// the back of its head may be separate components. Coinciding boundary vertices of the same
/// component stay separate.
class SurfaceDistance {
 public:
  /// \param positions  #V by 3. Topology and positions must outlive this object.
  SurfaceDistance(const Topology& topology, const Positions& positions);

  /// A vertex and its distance along the surface from the nearest start point.
  struct ReachedVertex {
    std::uint32_t vertex;
    double distance;
  };
  /// Returns the vertices at a distance of at most `reach` from the nearest of `points`, ascending
  /// by vertex. Uses fast marching (Novotni & Klein 2002, "Computing geodesic distances on
  /// triangular meshes"); paths may follow both diagonals of a quad.
  std::vector<ReachedVertex> vertices_within(const std::vector<SurfacePoint>& points,
                                             double reach) const;

  /// Returns the point on the surface that is nearest to `point`.
  SurfacePoint nearest(const Eigen::Vector3d& point) const;

  const Positions& positions() const { return positions_; }
  /// Returns the vertices adjacent to a vertex or to its twins (see next_twins_); the list may
  /// contain duplicates.
  std::vector<std::uint32_t> adjacent_vertices(std::uint32_t vertex) const;

 private:
  const Topology& topology_;
  const Positions& positions_;
  Adjacency adjacency_;
  VertexFaces faces_;
  /// #V. Twins are boundary vertices of different components at the same position. A vertex and its
  /// twins form a cyclic list; entry v is the vertex after v in this list, or v itself if v has no
  /// twin.
  std::vector<std::uint32_t> next_twins_;
  PointGrid grid_;
};

}  // namespace crowdface
