// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/core/hash.h"
#include "crowdface/io/glb_skin.h"
#include "crowdface/shapes/point_set.h"

namespace crowdface {

/// A rig of the template: joints, what each vertex is bound to, and where the joints stand at rest.
struct Rig {
  GlbSkin skin;     ///< in the heads' axes
  PointSet points;  ///< of the joints, in their order, beside the template
  Digest digest;

  bool empty() const { return skin.joints.empty(); }
};

}  // namespace crowdface
