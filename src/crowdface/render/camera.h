// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/view.h"

namespace crowdface {

/// A perspective camera with a square image and a long lens, as portraits are taken.
struct Camera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< appears in the image's centre
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  ///< unit vectors, at right angles
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d back = Eigen::Vector3d::UnitZ();  ///< from the target to the camera
  double distance = 1;                              ///< from the target to the camera
  double half_tangent = 0.17632698070846498;        ///< tangent of half the field of view

  Eigen::Vector3d position() const { return target + distance * back; }
  /// Half the side of what the image shows in the plane through the target.
  double half_extent() const { return distance * half_tangent; }
};

/// How heads stand in their files.
struct HeadFrame {
  Axis up = {1, 1};
  Axis front = {2, 1};  ///< where the faces look
};

struct FramingOptions {
  double field_of_view_degrees = 20;
  double margin = 0.06;  ///< left free on each side, as a fraction of the image's side
  double cut_below = 0;  ///< share of the heads' height, from the lowest vertex of all, that may
      ///< leave the picture: a portrait of a bust that shows the face larger; but never a chin
  /// Points that are shown beside the heads, such as hair; those too low to be shown of a head are not.
  std::vector<Eigen::Vector3d> beside = {};
};

/// The nearest camera that shows every vertex of every head, margin kept (but for what `cut_below`
/// gives up) and what is beside them: one for all faces of a set, so that their sizes compare.
/// \param heads  at least one; each #V by 3 in the files' unit, with at least one vertex.
/// \throws BrokenPrecondition if there is no vertex, or up and front are one axis; InvalidInput if a
/// coordinate is not finite.
Camera fit_camera(std::span<const Positions* const> heads, const HeadFrame& frame, View view,
                  const FramingOptions& options = {});

/// One camera a view, all with the same distance, so that sizes compare between views too.
std::vector<Camera> fit_cameras(std::span<const Positions* const> heads, const HeadFrame& frame,
                                std::span<const View> views, const FramingOptions& options = {});

}  // namespace crowdface
