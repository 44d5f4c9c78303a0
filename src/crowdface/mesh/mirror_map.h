// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// The points with n·x = d.
struct MirrorPlane {
  Eigen::Vector3d normal = {1, 0, 0};  ///< n, of length one
  double offset = 0;                   ///< d

  Eigen::Vector3d image(const Eigen::Vector3d& point) const;
};

/// Where on a mesh the other side of each vertex is: which side is left and which right is told by the
/// mean head, so that mirroring is a linear map of a head's positions, with one plane for all heads.
struct MirrorMap {
  MirrorPlane plane;
  std::vector<Triangle> corners;  ///< #V: the triangle of a vertex' place
  std::vector<std::array<double, 3>>
      shares;                          ///< #V: barycentric; {1, 0, 0} where the place is a vertex
  std::vector<std::uint32_t> without;  ///< vertices that have nothing on the other side, ascending
  Positions kept;  ///< #without by 3: what is added there so that the mean head keeps its form

  bool is_vertex(std::uint32_t v) const { return shares[v][0] == 1; }
};

/// M(A): at each vertex the image of what A has on the other side, #V by 3. Where all places are vertices
/// and the plane is a coordinate plane, M(M(A)) is A to the bit.
Positions mirrored(const MirrorMap& map, const Positions& positions);

/// (1 − w)·A + w·M(A), both known; to the bit A for w = 0 and M(A) for w = 1, and A where both are equal.
Positions between_mirrored(const Positions& positions, const Positions& image, double w);

/// How much of its mirror image a face takes whose left and right differ `asymmetry` times as much, and
/// that may be mirrored as a whole: A' = (1 + a)/2·A + (1 − a)/2·M(A), or the other way round.
double mirror_share(double asymmetry, bool mirrored);

}  // namespace crowdface
