// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// The two readings of Eq. 3, whose sums run from i = 1 and from i = 0.
enum class Normalization {
  kPartition,  ///< the target takes part as face 0 with its own detail; weights sum to one
  kPrinted,    ///< as printed: ω_0 counts in the denominator only
};

}  // namespace crowdface
