// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/crowd/crowd_status.h"

namespace crowdface {

/// Formats the status as a text table for people.
std::string format_status_table(const CrowdStatus& status);
/// Formats the status as one JSON object on one line.
std::string format_status_json(const CrowdStatus& status);

}  // namespace crowdface
