// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Where the camera stands: before the face, turned by 35 degrees, at its side, or behind it.
enum class View { kFront, kThreeQuarter, kProfile, kBack };

}  // namespace crowdface
