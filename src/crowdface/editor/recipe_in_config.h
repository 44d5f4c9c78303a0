// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "crowdface/config/config.h"

namespace crowdface {

/// A config's text with this recipe among its `recipes`: in place of the one with the same id, or as
/// the last. Every other line stays as it is, comments and order included.
/// \param source  the file's name, for messages
/// \throws UsageError if the recipes stand in one line, in [brackets].
std::string with_recipe(std::string_view text, const std::string& source, const HandRecipe& recipe,
                        const Config& config);

/// The same in the config's own file, which is replaced only by a text that reads back well.
/// \throws Error with every problem the config would have.
void put_recipe(const HandRecipe& recipe, const Config& config);

}  // namespace crowdface
