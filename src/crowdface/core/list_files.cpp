// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/list_files.h"

#include <algorithm>
#include <system_error>

namespace crowdface {

namespace fs = std::filesystem;

std::vector<fs::path> list_files(const fs::path& folder,
                                 const std::function<bool(const fs::path&)>& is_wanted,
                                 std::error_code* error) {
  std::error_code ignored;
  std::error_code& told = error != nullptr ? *error : ignored;
  std::vector<fs::path> files;
  for (fs::directory_iterator it(folder, told), end; !told && it != end; it.increment(told)) {
    if (is_wanted(it->path())) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return a.filename().native() < b.filename().native();
  });
  return files;
}

}  // namespace crowdface
