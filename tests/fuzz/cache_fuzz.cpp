// SPDX-License-Identifier: Apache-2.0
// An entry's checksum would stop the fuzzer at once, so the input gets the right one at its end.
#include <cstdlib>
#include <cstring>
#include <string>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/job/head_cache.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto folder = std::filesystem::temp_directory_path() /
                             ("crowdface_fuzz_cache_" + std::to_string(::getpid()));
  const crowdface::Digest key = {1, 2};
  const crowdface::HeadCacheShape shape = {8, 4, 3, 5, 60, crowdface::Levels::kBasis};
  std::string bytes(crowdface::fuzz::text_of(data, size));
  crowdface::Digest sum;
  if (bytes.size() >= sizeof sum) {
    sum = crowdface::hash_bytes(std::string_view(bytes).substr(0, bytes.size() - sizeof sum));
    std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
  }
  std::filesystem::create_directories(folder);
  crowdface::write_file(crowdface::cache_entry(folder, key), bytes);
  try {
    const auto head = crowdface::read_cached_head(folder, key, shape);
    double all = 0;  // every number that is promised can be read
    for (const float value : head->levels.fields) all += value;
    all += head->levels.mixing.sum() + head->trajectory.sum();
    if (head->levels.rank > shape.nodes) std::abort();
    if (all == 1e300) std::abort();  // keeps the sum from being left out
  } catch (const crowdface::Error&) {
  }
  return 0;
}
