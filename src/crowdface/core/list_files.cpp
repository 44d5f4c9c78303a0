// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/list_files.h"

#include "crowdface/core/folder.h"

namespace crowdface {

namespace fs = std::filesystem;

std::vector<fs::path> list_files(const fs::path& folder,
                                 const std::function<bool(const fs::path&)>& is_wanted,
                                 std::error_code* error) {
  std::vector<fs::path> files = list_folder(folder, error);
  std::erase_if(files, [&](const fs::path& path) { return !is_wanted(path); });
  return files;
}

}  // namespace crowdface
