// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// What a face must not be. Each limit is far from what faces between the heads reach, and is met by
/// extrapolation that goes too far (docs/casting.md has figures).
struct BelievabilityOptions {
  bool check = true;           ///< false: no candidate is judged by any of these
  double max_deviation = 2.5;  ///< from the heads' mean, see Plausibility
};

}  // namespace crowdface
