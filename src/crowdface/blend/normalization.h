// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// The two readings of Eq. 3, in which one sum runs from i = 1 and the other from i = 0.
enum class Normalization {
  kPartition,  ///< the target is face 0 and lends its own detail; the weights sum to one
  kPrinted,    ///< as printed: ω_0 occurs only in the denominator
};

}  // namespace crowdface
