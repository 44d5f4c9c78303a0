// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <system_error>
#include <vector>

#include "crowdface/core/descriptor.h"

namespace crowdface {

/// What stands in a folder, in the order of the names; nothing if there is no such folder.
/// \param error  set if there is none or it may not be read.
/// \throws IoError unless all of it could be read; without `error` if it may not be read, too.
std::vector<std::filesystem::path> list_folder(const std::filesystem::path& folder,
                                               std::error_code* error = nullptr);

/// What of it is wanted. \throws IoError like list_folder.
std::vector<std::filesystem::path> list_files(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& is_wanted,
    std::error_code* error = nullptr);

/// Of list_files: whether a path has this ending.
inline auto has_ending(const char* ending) {
  return [ending](const std::filesystem::path& path) { return path.extension() == ending; };
}

/// A folder and all folders below it, parents first; links are not followed.
/// \throws IoError like list_folder.
std::vector<std::filesystem::path> folders_from(const std::filesystem::path& root);

/// Whether a path, all links followed, leads to a place below a folder or to the folder itself. What
/// is not there lies where it would be made; of what cannot be told the answer is no.
bool leads_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// A folder that is known again however often its name is given to another.
class HeldFolder {
 public:
  /// \throws CannotCreate if it cannot be opened.
  explicit HeldFolder(const std::filesystem::path& folder);
  /// \throws IoError if it was removed or moved away, or another bears its name.
  void require_same() const;

 private:
  std::filesystem::path path_;
  Descriptor opened_;
};

}  // namespace crowdface
