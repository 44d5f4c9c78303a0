// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// What to do if a folder holds another crowd: refuse the folder, or remove that crowd's files.
enum class Replace { kRefuse, kForce };

}  // namespace crowdface
