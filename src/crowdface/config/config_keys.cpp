// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_keys.h"

#include <algorithm>

namespace crowdface {

std::string starter_lines(std::string_view key, const StarterLines& lines) {
  constexpr std::size_t kCommentColumn = 23;
  std::string text;
  for (const std::string_view line : split_lines(lines.above)) text += concat("\n# ", line);
  if (lines.value.empty()) return text;
  std::string line = entry(key, lines.value);
  if (!lines.beside.empty()) {
    line.resize(std::max(line.size() + 1, kCommentColumn), ' ');
    line += concat("# ", lines.beside);
  }
  return concat(text, '\n', line);
}

}  // namespace crowdface
