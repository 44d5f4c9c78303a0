// SPDX-License-Identifier: Apache-2.0
// Functions that read and write only those config entries that `crowdface edit` changes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// Reads one entry of `recipes` from YAML (or JSON, which is YAML). The entry is checked against
/// the heads and regions of `config`; its id may be any name.
///
/// \param source    name of the text in messages.
/// \param problems  receives every problem.
/// \return nothing if there is a problem.
std::optional<ManualRecipe> parse_manual_recipe(std::string_view text, const std::string& source,
                                                const Config& config, Problems& problems);

/// Returns a recipe as YAML: one item of the list `recipes`, without the dash that starts an item.
std::string format_manual_recipe(const ManualRecipe& recipe, const Config& config);

/// Reads the text of a review file, as if the config listed a file with this text.
///
/// \param source    name of the text in messages.
/// \param problems  receives every problem.
Review parse_review(std::string_view text, const std::string& source, const Config& config,
                    Problems& problems);

/// Reads the change of a face from YAML (or JSON, which is YAML), such as {age: older}. An empty
/// mapping gives an empty change.
///
/// \param id        the face that the change applies to.
/// \param problems  receives every problem.
/// \return nothing if there is a problem.
std::optional<FaceChange> parse_change(const std::string& id, std::string_view text,
                                       const Config& config, Problems& problems);

/// Writes a review as the text of a review file.
std::string format_review(const Review& review, const Config& config);

}  // namespace crowdface
