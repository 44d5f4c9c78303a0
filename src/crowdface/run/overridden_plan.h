// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Returns warnings about config keys that a cast crowd does not follow because other keys take
/// precedence: quotas of attachments, tags of attachments, groups, and `changes`. Each warning
/// gives the number of faces to which it applies.
std::vector<std::string> overridden_plan_warnings(const Config& config,
                                                  const std::vector<FacePlan>& crowd);

}  // namespace crowdface
