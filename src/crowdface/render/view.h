// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Viewing direction: the front view rotated about the vertical axis by 0, 35, 90 or 180 degrees.
enum class View { kFront, kThreeQuarter, kProfile, kBack };

}  // namespace crowdface
