// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Checks the mask images as far as possible without texture coordinates, which determine the UDIM
/// tiles in use.
void check_masks(const std::vector<std::string>& files, Problems& problems);

/// Warns about each mask that is one image although the skin lies in several UDIM tiles.
std::vector<std::string> lone_masks(const Config& config, const Inputs& inputs);

/// Warns about masks that have no useful effect.
std::vector<std::string> odd_masks(const Config& config, const Inputs& inputs);

}  // namespace crowdface
