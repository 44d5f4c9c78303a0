// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// The plane of the points x with n·x = d.
struct MirrorPlane {
  Eigen::Vector3d normal = {1, 0, 0};  ///< unit normal n
  double offset = 0;                   ///< distance d from the origin along n

  /// The mirror image of a point.
  Eigen::Vector3d mirrored(const Eigen::Vector3d& point) const;
};

/// Maps each vertex to its mirror point, a point on the surface on the other side of the head. The
/// mirror points and the plane are determined once, on the mean head, so that mirroring is the same
/// linear map of positions for all heads.
struct MirrorMap {
  MirrorPlane plane;  ///< the plane between the left and the right half of the mean head
  /// one per vertex: the vertex indices of the triangle that contains its mirror point
  std::vector<Triangle> corners;
  /// for each vertex, the barycentric coordinates of its mirror point in the triangle; {1, 0, 0} if
  /// the mirror point is a vertex
  std::vector<std::array<double, 3>> barycentric;
  std::vector<std::uint32_t> unpaired_vertices;  ///< vertices without a mirror point, ascending
  /// #unpaired_vertices by 3: offsets that are added to the mirror images of the unpaired vertices,
  /// so that mirroring moves these vertices of the mean head only a little.
  Positions unpaired_offsets;

  /// Whether vertex v has a mirror vertex, `corners[v][0]`: its mirror point is a vertex.
  bool has_mirror_vertex(std::uint32_t v) const { return barycentric[v][0] == 1; }
};

/// Returns the mirrored head M(A), #V by 3, for a head A = `positions`. In M(A), the position of a
/// vertex is the mirror image of the position that its mirror point has on A. If all mirror points
/// are vertices and the plane is a coordinate plane, M(M(A)) is bitwise equal to A.
Positions mirrored(const MirrorMap& map, const Positions& positions);

/// Returns (1 − w)·A + w·M(A) for given A and M(A). The result is bitwise equal to A for w = 0, to
/// M(A) for w = 1, and to A where A and M(A) are equal.
Positions blend_with_mirrored(const Positions& positions, const Positions& image, double w);

/// Weight of the mirror image in a head whose differences between left and right are scaled by the
/// factor a = `asymmetry`: A' = (1 + a)/2·A + (1 − a)/2·M(A). If `mirrored` is true, A and M(A)
/// swap their weights.
double mirror_image_weight(double asymmetry, bool mirrored);

}  // namespace crowdface
