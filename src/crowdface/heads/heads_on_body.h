// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/neck/seam.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// All heads on one body (config section `neck`). All heads are moved by translations and one
/// rotation; each finished face is rotated and its neck bent, so that its form above is the same as
/// without a body.
struct HeadsOnBody {
  /// How a head was placed.
  struct Head {
    RigidMotion placed;  ///< from the head's file to its place on the body; scale 1
    /// The rotation of faces of this target into the common pose of all heads, see turn_vector;
    /// zero if the head has that pose.
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    double moved_mm = 0;        ///< rms distance by which placement and turn move the ring
    double turned_degrees = 0;  ///< angle of placement and turn together
    double bent_mm = 0;         ///< largest distance of the placed and turned ring from the body's
  };
  Seam seam;
  std::vector<Head> heads;
  Eigen::Vector3d middle;   ///< of the seam
  Positions unplaced_mean;  ///< mean of the heads before they were placed
  double mm_per_unit = 1;
  /// The body, if pictures or files show it or faces get a texture for it; else null.
  std::shared_ptr<const Attachment> body;
  Rim body_rim;  ///< the body's vertex for each vertex of the ring; empty without `body`
  bool is_body(const Attachment& item) const { return body.get() == &item; }

  /// The rotation about the middle of the ring that brings a face of this recipe, before it is
  /// mirrored, into the common pose; none if its target has that pose.
  /// \param plane  in which an asymmetric face is mirrored; not read for other faces
  std::optional<RigidMotion> turning(const Recipe& recipe, const MirrorPlane* plane) const;

  Digest digest;  ///< hash of the seam, of `falloff`, and of the body if there is one
};

/// Returns the mean of the heads as they are without a body.
inline const Positions& unplaced_mean(const Inputs& inputs) {
  return inputs.neck ? inputs.neck->unplaced_mean : inputs.mean;
}

}  // namespace crowdface
