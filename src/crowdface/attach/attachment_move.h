// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// How an attachment follows the skin.
enum class AttachmentMove {
  kBend,   ///< each point follows the surrounding skin smoothly: hair, brows, beard
  kRigid,  ///< the whole attachment rotates, translates and scales: glasses
};

}  // namespace crowdface
