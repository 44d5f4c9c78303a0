// SPDX-License-Identifier: Apache-2.0
// What an editor changes, read and written without the rest of a config.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// Reads one entry of `recipes` by itself, in YAML (or JSON, which is YAML), as a config of these
/// heads and regions would take it; its id may be any name.
/// \param source    what messages call the text.
/// \param problems  takes every problem.
/// \return nothing if there is any.
std::optional<HandRecipe> parse_hand_recipe(std::string_view text, const std::string& source,
                                            const Config& config, Problems& problems);

/// The same as YAML: one item of the list `recipes`, without the dash before it.
std::string format_hand_recipe(const HandRecipe& recipe, const Config& config);

/// Reads a review as a config of this crowd would that names it, for its problems alone.
/// \param source    what messages call the text.
/// \param problems  takes every problem.
void check_review(std::string_view text, const std::string& source, const Config& config,
                  Problems& problems);

}  // namespace crowdface
