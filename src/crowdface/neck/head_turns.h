// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// The motion, of scale 1, that brings points of a head closest to the same points of another head. It
/// minimises the sum of the distances, not of their squares, so that a long chin or a large nose
/// hardly rotates a head (iteratively reweighted least squares).
/// \param from, to  #points by 3; at least three points that are not collinear
RigidMotion head_motion(const Positions& from, const Positions& to);

/// The part of a rotation that is a difference in pose. Heads in one pose differ by less: by up to 6
/// degrees about the axis through the ears, because faces are more or less inclined, and by up to 2
/// degrees about other axes, because heads are nearly symmetric. Smaller parts are left out.
/// \param across  the axis through the ears, a unit vector
Eigen::Matrix3d pose_part(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& across);

/// For each head, the rotation into the median pose of the heads, see pose_part; the identity if
/// there are fewer than three heads.
/// \param heads  the same points of each head, #points by 3
std::vector<Eigen::Matrix3d> rotations_to_median(const std::vector<Positions>& heads,
                                                 const Eigen::Vector3d& across);

/// A rotation as its axis times twice the tangent of half its angle. Such vectors can be mixed.
Eigen::Vector3d turn_vector(const Eigen::Matrix3d& rotation);

}  // namespace crowdface
