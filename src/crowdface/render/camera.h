// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/view.h"

namespace crowdface {

/// A perspective camera with a square image. The default field of view is 20 degrees, as for
/// portraits.
struct Camera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< point shown in the centre of the image
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  ///< `right`, `up` and `back` are orthonormal
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d back = Eigen::Vector3d::UnitZ();  ///< direction from the target to the camera
  double distance = 1;  ///< distance between target and camera, in the unit of the mesh files
  double tan_half_fov = 0.17632698070846498;  ///< tangent of half the field of view

  /// Position of the camera, in the unit of the mesh files.
  Eigen::Vector3d position() const { return target + distance * back; }
  /// Half the side of the image, measured in the plane through `target`, the point that the camera
  /// looks at.
  double half_extent() const { return distance * tan_half_fov; }
};

/// Orientation of the heads in their files.
struct HeadFrame {
  Axis up = {1, 1};     ///< direction of the top of the head; default +Y
  Axis front = {2, 1};  ///< direction in which the faces look; default +Z
};

/// How fit_camera and fit_cameras place the heads in the image.
struct FramingOptions {
  double field_of_view_degrees = 20;
  double margin = 0.06;  ///< free border on each side, as a fraction of the image's side
  /// Fraction of the heads' height that may be cut off at the bottom of the image, so that the face
  /// of a bust fills more of the image. Chins always stay visible.
  double bottom_cut_fraction = 0;
  /// Additional points that must be visible, such as points of the hair. Points below the visible
  /// part of the heads are ignored.
  std::vector<Eigen::Vector3d> extra_points = {};
};

/// Returns whether the lowest part of a head is wider than the rest of the head. Heads without
/// shoulders end at the neck.
/// \param lowest_fraction  the height of the lowest part, as a fraction of the head's height.
bool has_shoulders(const Positions& head, const HeadFrame& frame, double lowest_fraction);

/// Returns the camera at the smallest distance at which all vertices of all heads and
/// `extra_points` are visible, except the part that `bottom_cut_fraction` allows to cut off. Use
/// one camera for all faces of a set, so that their sizes are comparable.
/// \param heads  at least one; each #V by 3 in the unit of the files, with at least one vertex.
/// \throws BrokenPrecondition if there is no vertex, or if up and front are the same axis;
///     InvalidInput if a coordinate is not finite.
Camera fit_camera(std::span<const Positions* const> heads, const HeadFrame& frame, View view,
                  const FramingOptions& options = {});

/// Returns one camera per view, all at the same distance, so that sizes are comparable between
/// views too.
std::vector<Camera> fit_cameras(std::span<const Positions* const> heads, const HeadFrame& frame,
                                std::span<const View> views, const FramingOptions& options = {});

}  // namespace crowdface
