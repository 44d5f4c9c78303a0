// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// The way in which an attachment moves with the skin of a new face.
enum class AttachmentMove {
  /// each point of the attachment follows the surrounding skin smoothly, as for hair and beards
  kBend,
  kRigid,  ///< the attachment rotates, translates and scales as a whole, as for glasses
};

}  // namespace crowdface
