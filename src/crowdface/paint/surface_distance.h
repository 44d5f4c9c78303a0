// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Lengths of ways along a mesh, never through the air: from lip to lip they go around the corner of the
/// mouth. Components whose open rims coincide vertex by vertex are one surface (a face and the back of its
/// head may be pieces of their own); rims of one component never are.
class SurfaceDistance {
 public:
  /// \param positions  #V by 3. Topology and positions must outlive it.
  SurfaceDistance(const Topology& topology, const Positions& positions);

  struct Reached {
    std::uint32_t vertex;
    double distance;
  };
  /// Vertices whose way to the nearest of some places is at most `reach`, ascending. Waves run over the
  /// triangles as on a plane (Novotni & Klein 2002, "Computing geodesic distances on triangular
  /// meshes"); a quad counts with both its diagonals.
  std::vector<Reached> within(const std::vector<SurfacePoint>& places, double reach) const;

  /// The place on the surface that is nearest to a point.
  SurfacePoint nearest(const Eigen::Vector3d& point) const;

  const Positions& positions() const { return positions_; }
  /// The vertices next to one, those of coinciding rims too; some may stand there twice.
  std::vector<std::uint32_t> around(std::uint32_t vertex) const;

 private:
  const Topology& topology_;
  const Positions& positions_;
  Adjacency adjacency_;
  FacesAround faces_;
  /// #V: the vertex that lies in the same place on another rim, then the next, in a ring; alone: itself.
  std::vector<std::uint32_t> twins_;
  PointGrid grid_;
};

}  // namespace crowdface
