// SPDX-License-Identifier: Apache-2.0
// What is told of a crowd that was cast, in the log and in the report.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/run/casting.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// A warning of faces that pass for one of the heads, if there are any that were drawn.
std::vector<std::string> near_heads(const Cast& cast, const std::vector<std::string>& heads);

/// Logs what the crowd is like: distances and candidates thrown away.
void log_casting(const Cast& cast);

/// What was asked, what was reached, what was thrown away.
nlohmann::ordered_json casting_to_json(const Config& config, const Cast& cast);

}  // namespace crowdface
