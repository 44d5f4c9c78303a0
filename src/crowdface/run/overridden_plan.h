// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Returns warnings about quotas of attachments, tags of attachments, groups and `changes` of the
/// config that have no effect on some faces of a cast crowd, because other keys override them. Each
/// warning gives the number of these faces.
std::vector<std::string> overridden_plan_warnings(const Config& config,
                                                  const std::vector<FacePlan>& crowd);

}  // namespace crowdface
