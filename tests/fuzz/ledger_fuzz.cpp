// SPDX-License-Identifier: Apache-2.0
// A line's checksum would stop the fuzzer at once, so each line of the input gets the right one.
#include <algorithm>

#include "crowdface/core/text.h"
#include "crowdface/crowd/ledger.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = crowdface::fuzz::text_of(data, size);
  std::string summed;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    const std::string sum = crowdface::hash_bytes(line).hex();
    summed += crowdface::concat(line, ",\"sum\":\"", sum, "\"}\n");
    begin = end + 1;
  }
  crowdface::parse_ledger(std::string(text));
  for (const auto& entry : crowdface::parse_ledger(summed).entries) {
    crowdface::format_ledger_line(entry);
  }
  return 0;
}
