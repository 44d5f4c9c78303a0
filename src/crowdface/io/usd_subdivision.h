// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// How a USD mesh is to be subdivided when it is shown.
enum class Subdivision { kNone, kCatmullClark };

}  // namespace crowdface
