// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Returns warnings about config keys that other keys override in a cast crowd: quotas of
/// attachments, tags of attachments, groups, and `changes`. Each warning gives the number of
/// affected faces.
std::vector<std::string> overridden_plan_warnings(const Config& config,
                                                  const std::vector<FacePlan>& crowd);

}  // namespace crowdface
