// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// The rotation and translation that bring points of a head closest to the corresponding points of
/// another head. Minimises the sum of the distances, not the sum of the squared distances, so that
/// a long chin or a large nose hardly rotates a head (iteratively reweighted least squares).
/// \param from, to  #points by 3; at least three points that are not collinear
RigidMotion head_motion(const Positions& from, const Positions& to);

/// Returns the part of the rotation between two heads that their different poses cause. The
/// rotations of heads in the same pose also differ: by up to 6 degrees about the axis through the
/// ears (the inclination of faces varies) and by up to 2 degrees about other axes (heads are nearly
/// symmetric). This function removes such differences.
/// \param across  the axis through the ears, a unit vector
Eigen::Matrix3d pose_difference(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& across);

/// Returns, for each head, the rotation into the median pose of all heads (see pose_difference).
/// All rotations are the identity if there are fewer than three heads.
/// \param heads   corresponding points of each head, #points by 3
/// \param across  the axis through the ears, a unit vector
std::vector<Eigen::Matrix3d> rotations_to_median(const std::vector<Positions>& heads,
                                                 const Eigen::Vector3d& across);

/// Twice the Rodrigues vector of a rotation: axis · 2 tan(angle / 2). A weighted mean of these
/// vectors is again the vector of a rotation.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);

}  // namespace crowdface
