// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Eq. 3 of the paper can be read in two ways, because one of its sums starts at i = 1 and the
/// other at i = 0.
enum class Normalization {
  /// the target is source number 0 and lends its own detail; all weights together sum to one
  kPartition,
  kPrinted,  ///< as printed in the paper: the target's weight ω_0 occurs only in the denominator
};

}  // namespace crowdface
