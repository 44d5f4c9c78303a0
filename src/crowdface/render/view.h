// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Where the camera stands: before the face, turned by 35 degrees, or at its side.
enum class View { kFront, kThreeQuarter, kProfile };

}  // namespace crowdface
