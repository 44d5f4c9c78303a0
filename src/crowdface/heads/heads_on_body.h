// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/neck/seam.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// All heads on one body (config section `neck`). All heads get the same rotation, and each head
/// its own translation. Each finished face is rotated and its neck is bent, so that above the bend
/// the face has the same shape as it would have without a body.
struct HeadsOnBody {
  /// How a head was placed on the body.
  struct Head {
    /// rigid motion of the head from its position in its file to its position on the body
    RigidMotion placement;
    /// The rotation of the placed head into the common pose of all heads, see rotation_vector; zero
    /// if the head has that pose.
    Eigen::Vector3d pose_rotation = Eigen::Vector3d::Zero();
    double shift_mm = 0;  ///< rms distance by which placement and pose rotation move the neck ring
    double rotation_degrees =
        0;  ///< angle of the rotation that combines placement and pose rotation
    /// after placement and pose rotation: largest distance between a vertex of the head's ring and
    /// the matching vertex of the body's ring
    double max_bend_mm = 0;
  };
  Seam seam;                        ///< the neck ring in which all faces end
  std::vector<Head> heads;          ///< how each head was placed
  Eigen::Vector3d seam_centre;      ///< centre of the seam between heads and body
  Positions mean_before_placement;  ///< mean of the heads before they were placed on the body
  double mm_per_unit = 1;           ///< millimetres per file unit
  /// The body, if renders or mesh files contain it or if each face gets a texture of the body.
  /// Otherwise null.
  std::shared_ptr<const Attachment> body;
  /// For each vertex of the heads' neck rim (`seam.rim`): the vertex of the body at the same place.
  /// Empty without `body`.
  Rim body_rim;
  /// Whether an attachment is the body's mesh, which is stored like an attachment.
  bool is_body(const Attachment& item) const { return body.get() == &item; }

  /// Whether at least one placed head does not have the common pose.
  bool has_differing_poses() const {
    return std::ranges::any_of(heads,
                               [](const Head& head) { return !head.pose_rotation.isZero(0); });
  }

  /// hash of the seam, of `falloff`, and of the heads' pose rotations; also of the body and the
  /// body's texture, if the config has them
  Digest digest;
};

/// A rotation about the point `middle`. \param turn  see rotation_vector
inline RigidMotion rotation_about(const Eigen::Vector3d& middle, const Eigen::Vector3d& turn) {
  return nudged({}, middle, Eigen::Vector3d::Zero(), turn, 0);
}

/// Returns the mean of the heads before they are placed on a body.
inline const Positions& mean_before_placement(const Inputs& inputs) {
  return inputs.heads_on_body ? inputs.heads_on_body->mean_before_placement : inputs.mean_head;
}

}  // namespace crowdface
