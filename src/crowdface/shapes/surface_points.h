// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/mesh/triangles.h"
#include "crowdface/shapes/point_carrier.h"

namespace crowdface {

/// The points that lie on a vertex or a triangle of their mesh. They stay exactly on the same
/// vertex or triangle on every face, whereas a PointCarrier moves points with the surrounding skin.
class SurfacePoints {
 public:
  /// \param triangles  triangles of the mesh.
  SurfacePoints(const PointSet& points, std::span<const Triangle> triangles);

  /// Puts these points on the surface of a face. Leaves all other points unchanged.
  /// \param target   The head that the face is built on.
  /// \param face     #V by 3.
  /// \param carried  #names by 3.
  void place(Index target, const Positions& face, Positions& carried) const;

 private:
  struct TrianglePoint {
    Triangle corners;
    std::array<double, 3> shares;  ///< barycentric coordinates
  };
  static std::optional<TrianglePoint> point_on_surface(const Eigen::Vector3d& point,
                                                       const Positions& mesh,
                                                       std::span<const Triangle> triangles);

  /// #meshes by #names: empty for a point that does not lie on the surface
  std::vector<std::vector<std::optional<TrianglePoint>>> surface_points_;
};

}  // namespace crowdface
