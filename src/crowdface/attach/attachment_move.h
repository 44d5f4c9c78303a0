// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// The way in which an attachment moves with the skin of a new face.
enum class AttachmentMove {
  kBend,   ///< each point follows the surrounding skin smoothly: hair, brows, beard
  kRigid,  ///< the whole attachment rotates, translates and scales: glasses
};

}  // namespace crowdface
