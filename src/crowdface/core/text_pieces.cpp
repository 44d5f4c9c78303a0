// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text_pieces.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {

TextPieces text_of_items(std::size_t count, std::function<std::string(std::size_t)> item) {
  return [count, item = std::move(item)](const TextSink& take) {
    constexpr std::size_t kAtOnce = 1024, kBlock = 16;
    std::vector<std::string> texts;
    for (std::size_t first = 0; first < count; first += texts.size()) {
      throw_if_interrupted();
      texts.resize(std::min(kAtOnce, count - first));
      parallel_for_each(texts.size(), kBlock, [&](std::size_t i) { texts[i] = item(first + i); });
      for (const std::string& text : texts) take(text);
    }
  };
}

std::string whole_text(const TextPieces& text) {
  std::string whole;
  text([&](std::string_view piece) { whole += piece; });
  return whole;
}

FileDigest digest_of(const TextPieces& text) {
  Hasher hasher;
  FileDigest content;
  text([&](std::string_view piece) {
    hasher.add_raw(piece);
    content.bytes += piece.size();
  });
  content.digest = hasher.digest();
  return content;
}

void read_lines(const std::filesystem::path& path,
                const std::function<void(std::string_view line, bool has_line_end)>& use) {
  std::string begun;  // the start of a line that continues in the next piece
  read_pieces(path, [&](std::string_view piece) {
    for (std::size_t end = 0; (end = piece.find('\n')) != piece.npos;
         piece.remove_prefix(end + 1)) {
      if (begun.empty()) {
        use(piece.substr(0, end), true);
        continue;
      }
      begun += piece.substr(0, end);
      use(begun, true);
      begun.clear();
    }
    begun += piece;
  });
  if (!begun.empty()) use(begun, false);
}

}  // namespace crowdface
