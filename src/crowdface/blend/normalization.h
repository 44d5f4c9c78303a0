// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// The two readings of Eq. 3 in the paper, in which one sum starts at i = 1 and the other sum at i
/// = 0.
enum class Normalization {
  kPartition,  ///< the target takes part as face 0 with its own detail; the weights sum to one
  kPrinted,    ///< as printed in the paper: ω_0 occurs only in the denominator
};

}  // namespace crowdface
