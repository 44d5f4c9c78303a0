// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Reads the points that a config names into inputs whose faces and shapes are known. Every problem is
/// added, with its line: a value that is no position, a head that is missing, a template that is not in
/// the heads' topology.
void load_points(const Config& config, Inputs& inputs, Problems& problems);

}  // namespace crowdface
