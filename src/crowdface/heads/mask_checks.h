// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Checks the mask images before texture coordinates are known. Without texture coordinates, the
/// check cannot tell which UDIM tiles are in use.
void check_masks(const std::vector<std::string>& files, Problems& problems);

/// Warns about each mask that is a single image although the skin lies in several UDIM tiles.
std::vector<std::string> single_image_mask_warnings(const Config& config, const Inputs& inputs);

/// Warns about masks that have no useful effect on the faces.
std::vector<std::string> ineffective_mask_warnings(const Config& config, const Inputs& inputs);

}  // namespace crowdface
