// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A config's text with these regions in place of its own. Every other line stays as it is, comments
/// and order included; a section in {braces} is written anew.
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
