// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/triangles.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface {

/// A place on a surface that was pointed at.
struct PickedPlace {
  std::uint32_t vertex = kNoIndex;  ///< the nearest of the triangle's
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< between those of the vertices, unit
};

/// A whole mesh that can be asked, from any thread, what a ray meets and what is near a place; the page shows
/// one of fewer triangles.
class PickableMesh {
 public:
  /// \param positions  #V by 3, finite, any unit
  /// \param skin       what can be picked
  /// \param others     what stands in front of it as well: eyes, teeth
  PickableMesh(Positions positions, std::vector<Triangle> skin,
               const std::vector<Triangle>& others = {});
  PickableMesh(const PickableMesh&) = delete;
  PickableMesh& operator=(const PickableMesh&) = delete;

  /// The first place of the skin along a ray. Where that meets something else first, the skin beside it if
  /// it is within `beside`: the corner of an eye is pointed at as often as the skin around it.
  /// \param direction  any length but 0
  std::optional<PickedPlace> cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  double beside) const;
  /// What a ray meets first: a row of `skin` then of `others`, and the place.
  struct Met {
    std::uint32_t triangle = 0;
    bool is_skin = false;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };
  std::optional<Met> meet(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// The place of the skin nearest to a point, of what faces within `least_cosine` of a unit vector.
  std::optional<PickedPlace> nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                                     double least_cosine, double reach) const;
  PickedPlace at_vertex(std::uint32_t vertex) const;
  /// The place as near to a point as the skin comes.
  PickedPlace at_point(const Eigen::Vector3d& point) const;

  const Positions& positions() const { return positions_; }
  const std::vector<Triangle>& skin() const { return skin_; }
  Eigen::Vector3d low() const { return box_.min(); }
  Eigen::Vector3d high() const { return box_.max(); }

  /// For the page: about so many triangles at most, normals of the whole mesh; a BinaryAnswer of `origin` (from
  /// which its points are counted), `low`, `high`, and the arrays positions, normals (sixteen bits a number), triangles,
  /// part (1: no skin).
  std::string preview(std::size_t most_triangles) const;

 private:
  PickedPlace place_of(const Triangle& corners, const std::array<double, 3>& shares) const;

  Positions positions_;
  std::vector<Triangle> skin_;
  std::vector<Quad> quads_;  ///< of skin, then of others
  Positions normals_;
  Eigen::AlignedBox3d box_;  ///< of the skin
  Eigen::Vector3d middle_;
  RayDevice device_;
  RayScene scene_;
  SurfaceTree tree_;
};

}  // namespace crowdface
