// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Returns warnings about settings of the config that have no effect on some faces of a cast crowd,
/// because other keys override them. Checks the quotas and tags of attachments, the groups, and the
/// changes of single faces (key `changes`). Each warning gives the number of faces on which the
/// setting has no effect.
std::vector<std::string> overridden_plan_warnings(const Config& config,
                                                  const std::vector<FacePlan>& crowd);

}  // namespace crowdface
