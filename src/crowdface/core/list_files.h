// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace crowdface {

/// What lies directly in a folder and is wanted, by name.
/// \param error  set if the folder is not there or may not be read; without it one that is not there
///               holds nothing.
/// \throws IoError like list_folder.
std::vector<std::filesystem::path> list_files(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& is_wanted,
    std::error_code* error = nullptr);

/// Of list_files: whether a path has this ending.
inline auto has_ending(const char* ending) {
  return [ending](const std::filesystem::path& path) { return path.extension() == ending; };
}

}  // namespace crowdface
