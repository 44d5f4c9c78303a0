// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "crowdface/mesh/triangles.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/parts/socket.h"

namespace crowdface {

/// Named points that come with a mesh, such as joints, centres of eyes and positions of ear rings.
/// Every generated face gets these points too.
struct PointSet {
  std::vector<std::string> names;
  /// Each entry is #names by 3. A single entry holds the points for all faces. Otherwise entry h
  /// holds the points for the faces that are built on head h.
  std::vector<Positions> positions;
  /// The mesh to which each entry of `positions` belongs, #V by 3.
  std::vector<Positions> meshes;

  bool empty() const { return names.empty(); }
};

/// Transfers named points to faces. A point on a vertex or a triangle of the mesh keeps its
/// barycentric coordinates there. A point inside an eyeball, or nearer to another rigid part than
/// to the skin, moves with this part. Any other point moves with the similarity transform that best
/// fits the motion of the skin near it. If the face is the points' own mesh, rotated, translated
/// and scaled, the points undergo the same motion up to rounding.
class PointCarrier {
 public:
  /// \param points     Must outlive this object.
  /// \param skin       Vertices of the skin; at least three that are not collinear.
  /// \param triangles  All triangles of the mesh.
  PointCarrier(const PointSet& points, const PartList& parts, std::span<const std::uint32_t> skin,
               std::span<const Triangle> triangles);

  /// Returns the positions of all points on a face.
  /// \param target  The head that the face is built on. If each head has its own points, this
  ///                head's points are used.
  /// \param face    #V by 3.
  /// \return        #names by 3.
  Positions place_points(Index target, const Positions& face) const;

 private:
  /// A fixed place on a triangle of the mesh, given by barycentric coordinates.
  struct TrianglePoint {
    Triangle corners;
    std::array<double, 3> barycentric;  ///< barycentric coordinates
  };
  /// What a point follows: a fixed position on a triangle, or the motion of a group of vertices (a
  /// similarity transform).
  using Anchor = std::variant<TrianglePoint, Socket>;

  /// Returns the place of a point on the triangles; nothing if the point is not on the surface.
  static std::optional<TrianglePoint> point_on_surface(const Eigen::Vector3d& point,
                                                       const Positions& mesh,
                                                       std::span<const Triangle> triangles);
  /// Finds the vertices that carry a point along when they move: the vertices of a rigid part, or
  /// the skin around the point.
  static Socket find_carrying_vertices(const Eigen::Vector3d& point, const Positions& mesh,
                                       const PartList& parts, std::span<const std::uint32_t> skin);

  const PointSet& points_;
  /// anchors_[m][p]: what the point number p of mesh m follows. There is one mesh, or one for each
  /// head.
  std::vector<std::vector<Anchor>> anchors_;
};

}  // namespace crowdface
