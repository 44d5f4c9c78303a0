// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/neck/seam.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// All heads on one body (config section `neck`). Heads are moved only; the neck of each finished
/// face is bent, so that the face above is the same as without a body.
struct HeadsOnBody {
  /// How a head was placed.
  struct Head {
    RigidMotion placed;   ///< from the head's file to its place on the body; scale 1
    double moved_mm = 0;  ///< rms distance by which the placement moves the ring
    double bent_mm = 0;   ///< largest distance of the placed ring from the body's
  };
  Seam seam;
  std::vector<Head> heads;
  Positions unplaced_mean;  ///< mean of the heads before they were placed
  double mm_per_unit = 1;
  /// The body, if pictures or files show it or faces get a texture for it; else null.
  std::shared_ptr<const Attachment> body;
  Rim body_rim;  ///< the body's vertex for each vertex of the ring; empty without `body`
  bool is_body(const Attachment& item) const { return body.get() == &item; }

  Digest digest;  ///< hash of the seam, of `falloff`, and of the body if there is one
};

/// Returns the mean of the heads as they are without a body.
inline const Positions& unplaced_mean(const Inputs& inputs) {
  return inputs.neck ? inputs.neck->unplaced_mean : inputs.mean;
}

}  // namespace crowdface
