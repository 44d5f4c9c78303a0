// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Reads the attachments that a config names, in parallel, into inputs whose faces are known. Every
/// problem is added: a mesh that cannot be read, one that lies far from the head, a fitted head in
/// another topology. What their materials lack is warned of.
void load_attachments(const Config& config, Inputs& inputs, Problems& problems);

}  // namespace crowdface
