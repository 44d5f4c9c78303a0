// SPDX-License-Identifier: Apache-2.0
// The casting part of the report.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/run/casting.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// The founders as they stand in founders.jsonl: lines as in a plan.
std::string format_founders(const Job& job, const std::vector<FamilyFounder>& founders);
/// Those that stand in the folder; none if it has no such file.
std::vector<FamilyFounder> read_founders(const Job& job, const CrowdDirectory& directory);

/// What was asked, what was reached, what was thrown away.
nlohmann::ordered_json casting_to_json(const Config& config, const Cast& cast);

}  // namespace crowdface
