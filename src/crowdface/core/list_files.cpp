// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/list_files.h"

#include <system_error>

#include "crowdface/core/folder.h"

namespace crowdface {

namespace fs = std::filesystem;

std::vector<fs::path> list_files(const fs::path& folder,
                                 const std::function<bool(const fs::path&)>& is_wanted,
                                 std::error_code* error) {
  if (error != nullptr) {
    const fs::directory_iterator opened(folder, *error);
    for (const std::errc none :
         {std::errc::no_such_file_or_directory, std::errc::not_a_directory,
          std::errc::filename_too_long, std::errc::too_many_symbolic_link_levels,
          std::errc::permission_denied}) {
      if (*error == none) return {};
    }
    error->clear();  // a failure of the disk is told as such
  }
  std::vector<fs::path> files = list_folder(folder);
  std::erase_if(files, [&](const fs::path& path) { return !is_wanted(path); });
  return files;
}

}  // namespace crowdface
