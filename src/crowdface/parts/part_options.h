// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// How the shape of a rigid part in a new face is determined.
enum class PartShape {
  kTarget,  ///< the part keeps the shape that it has in the target head
  kBlend,   ///< the part's shape is blended from target and sources, like skin (Eq. 7)
};

/// How a generated face treats lips and other skin that nearly touches skin.
enum class ContactHandling {
  kAuto,  ///< each gap gets a width between its smallest and largest width on target and sources
  kNone,  ///< each gap keeps the width that the blend (Eq. 7) gives it
};

}  // namespace crowdface
