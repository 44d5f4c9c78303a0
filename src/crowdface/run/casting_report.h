// SPDX-License-Identifier: Apache-2.0
// Reports on a cast crowd, for the log and report.json.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/run/casting.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Warns about sampled faces that look too much like one of the heads.
std::vector<std::string> warnings_about_faces_near_heads(const CrowdPlan& crowd_plan,
                                                         const std::vector<std::string>& heads);

/// Logs statistics of the crowd: distances and rejected candidates.
void log_casting(const CrowdPlan& crowd_plan);

/// JSON with the constraints, the values that the crowd reaches, and the numbers of rejected
/// candidates.
nlohmann::ordered_json casting_to_json(const Config& config, const CrowdPlan& crowd_plan);

}  // namespace crowdface
