// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// The subdivision scheme of a USD mesh.
enum class Subdivision { kNone, kCatmullClark };

}  // namespace crowdface
