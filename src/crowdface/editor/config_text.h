// SPDX-License-Identifier: Apache-2.0
// Changes to the text of a config: every other line stays as it is, comments and order included.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config.h"

namespace crowdface {

/// A config's text with this recipe among its `recipes`: in place of the one with the same id, or as
/// the last.
/// \param source  the file's name, for messages
/// \throws Error with everything about the text that is not YAML.
std::string with_recipe(std::string_view text, const std::string& source, const HandRecipe& recipe,
                        const Config& config);

/// The same in the config's own file, which is replaced only by a text that reads back well.
/// \throws Error with every problem the config would have.
void put_recipe(const HandRecipe& recipe, const Config& config);

/// A config's text with these regions in place of its own; a section in {braces} is written anew.
/// \param source  the file's name, for messages
/// \param masks   the images as the config is to name them
std::string with_regions(std::string_view text, const std::string& source,
                         const std::vector<std::string>& names,
                         const std::vector<std::string>& masks);

/// The same in a config's file, which names the images from its own folder on.
/// \throws Error with every problem that the config would have, and leaves it as it is: a region
///         that is gone may be named elsewhere.
void put_regions(const std::filesystem::path& config, const std::vector<std::string>& names,
                 const std::vector<std::filesystem::path>& masks);

}  // namespace crowdface
