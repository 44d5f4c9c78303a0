// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_keys.h"

#include <algorithm>

namespace crowdface {

std::string starter_lines(std::string_view key, const StarterLines& lines) {
  constexpr std::size_t kCommentColumn = 23;
  std::string text;
  for (std::size_t begin = 0; begin < lines.above.size();) {
    const std::size_t end = std::min(lines.above.find('\n', begin), lines.above.size());
    text += concat("\n# ", std::string_view(lines.above).substr(begin, end - begin));
    begin = end + 1;
  }
  if (lines.value.empty()) return text;
  std::string line = entry(key, lines.value);
  if (!lines.beside.empty()) {
    line.resize(std::max(line.size() + 1, kCommentColumn), ' ');
    line += concat("# ", lines.beside);
  }
  return concat(text, '\n', line);
}

}  // namespace crowdface
