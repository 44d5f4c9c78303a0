// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// What a rigid part looks like in a generated face.
enum class PartShape {
  kTarget,  ///< as in the target
  kBlend,   ///< as blended like skin (Eq. 7)
};

/// What becomes of lips, and of other skin that nearly touches skin, in a generated face.
enum class Contacts {
  kAuto,  ///< they are as far apart as in the target and the sources
  kNone,  ///< as blended (Eq. 7)
};

}  // namespace crowdface
