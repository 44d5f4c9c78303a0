// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Opens the mask images as far as that goes without texture coordinates, which alone tell the UDIM
/// tiles in use.
void check_masks(const std::vector<std::string>& files, Problems& problems);

/// A warning for each mask that is one image where the skin lies in several tiles.
std::vector<std::string> lone_masks(const Config& config, const Inputs& inputs);

/// Warnings of masks that do not do what masks are for.
std::vector<std::string> odd_masks(const Config& config, const Inputs& inputs);

}  // namespace crowdface
