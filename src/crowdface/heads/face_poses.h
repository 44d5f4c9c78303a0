// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/heads_at_samples.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/prepare.h"

namespace crowdface {

/// The poses of faces on a body (config section `neck`), if the poses of the heads differ. The pose
/// of a blended face lies between the poses of its target and of its sources, because detail keeps
/// the pose of the head that it comes from. The more the recipe smooths the target, the smaller is
/// the weight of the target's pose.
class FacePoses {
 public:
  /// \param inputs  must outlive this object; its heads are placed on a body
  FacePoses(const Inputs& inputs, const PreparedHeads& prepared, const RegionWeights& regions);
  FacePoses(const FacePoses&) = delete;
  FacePoses& operator=(const FacePoses&) = delete;

  /// Returns the rigid motion that aligns a blended face, before it is mirrored, with the face that
  /// the same recipe gives for heads in the common pose. Returns nothing if the recipe uses only
  /// heads in the common pose and no mirror image.
  /// \param plane  the plane in which faces are mirrored; needed only for a mirrored or asymmetric
  ///               face
  std::optional<RigidMotion> motion_of(const Recipe& recipe, const MirrorPlane* plane) const;

 private:
  /// Returns whether a head with weight in the recipe was rotated to the common pose.
  bool uses_rotated_head(const Recipe& recipe) const;

  const HeadsOnBody& heads_on_body_;
  /// Samples of each head, as placed on the body, in file units. The samples are vertices of the
  /// skin above the part of the neck that bends.
  HeadsAtSamples placed_heads_;
  HeadsAtSamples heads_in_common_pose_;  ///< `placed_heads_`, rotated to the common pose
  /// motion of the mean head from its pose on the body to the common pose
  RigidMotion mean_motion_;
};

}  // namespace crowdface
