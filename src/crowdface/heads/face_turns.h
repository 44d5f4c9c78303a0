// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/sampled_heads.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/prepare.h"

namespace crowdface {

/// The poses of faces on a body (config section `neck`), if some heads have another pose than the
/// others. The pose of a blended face lies between the pose of its target and the poses of its
/// sources, because the sources' detail keeps their poses. The smoother the target, the less the
/// target's pose counts.
class FaceTurns {
 public:
  /// \param inputs  must outlive this object; its heads are placed on a body
  FaceTurns(const Inputs& inputs, const Prepared& prepared, const RegionWeights& regions);
  FaceTurns(const FaceTurns&) = delete;
  FaceTurns& operator=(const FaceTurns&) = delete;

  /// Returns the rigid motion that aligns a blended face, before it is mirrored, with the face that
  /// the same recipe gives for heads in the common pose. Returns nothing if the recipe uses no head
  /// of another pose and no mirror image.
  /// \param plane  in which faces are mirrored; read only for a mirrored or asymmetric face
  std::optional<RigidMotion> motion_of(const Recipe& recipe, const MirrorPlane* plane) const;

 private:
  bool has_turned_head(const Recipe& recipe) const;

  const HeadsOnBody& neck_;
  SampledHeads placed_, turned_;  ///< above the bend, in file units: as placed, in the common pose
  RigidMotion mean_;              ///< the mean head's motion from its placed to the common pose
};

}  // namespace crowdface
