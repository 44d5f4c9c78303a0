// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/library_line.h"

#include "crowdface/core/text.h"

namespace crowdface {

std::string library_line(const std::vector<MaterialFile>& files,
                         const std::filesystem::path& from) {
  std::string line;
  for (const MaterialFile& file : files) {
    if (!file.is_library) continue;
    line += concat(line.empty() ? "mtllib " : " ", (from / file.relative).generic_string());
  }
  return line;
}

}  // namespace crowdface
