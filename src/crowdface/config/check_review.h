// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// Reads a review as a config of this crowd would that names it, for its problems alone.
/// \param source    what messages call the text.
/// \param problems  takes every problem.
void check_review(std::string_view text, const std::string& source, const Config& config,
                  Problems& problems);

}  // namespace crowdface
