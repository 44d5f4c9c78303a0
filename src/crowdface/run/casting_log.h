// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/run/casting.h"

namespace crowdface {

/// A warning of faces that pass for one of the heads, if there are any that were drawn.
std::optional<std::string> near_heads(const Cast& cast, const std::vector<std::string>& heads);

/// Logs what the crowd is like: distances, candidates thrown away, faces too near to heads.
void log_casting(const Cast& cast, const std::vector<std::string>& heads);

}  // namespace crowdface
