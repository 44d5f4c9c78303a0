// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// How an attachment goes along with the skin under it.
enum class AttachmentMove {
  kBend,   ///< each place with the skin around it, smoothly: hair, brows, beard
  kRigid,  ///< as a whole, turned, moved and scaled: glasses
};

}  // namespace crowdface
