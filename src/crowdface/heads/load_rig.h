// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Reads the rig that a config names into inputs whose faces and shapes are known. Its vertices are found by
/// `_VERTEX_ID`, or by where they lie on the shapes' template or on one of the heads. A problem is added if some vertex
/// of the heads has none, or a joint's scale is not the same along its axes.
void load_rig(const Config& config, Inputs& inputs, Problems& problems);

}  // namespace crowdface
