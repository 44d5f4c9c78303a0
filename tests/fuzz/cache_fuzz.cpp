// SPDX-License-Identifier: Apache-2.0
// An entry's key and checksum would stop the fuzzer at once, so the input gets the right ones.
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/head_cache.h"
#include "crowdface/heads/read_cache.h"
#include "crowdface/mesh/adjacency.h"

#include "fuzz/input_file.h"

namespace {

using namespace crowdface;

/// Every number that is promised can be read.
void read_all(const PreparedHead& head, const HeadCacheSizes& shape) {
  double all = 0;
  const LevelFields& fields = head.levels.fields;
  for (Index p = 0; p < fields.rank; ++p) {
    for (Index v = 0; v < fields.vertex_count; ++v) all += fields.value(p, v, 0);
  }
  for (const std::int16_t number : fields.quantized_values) all += number;
  all += head.levels.function_coefficients.sum() + head.smoothing_trajectory.sum();
  if (fields.rank > shape.level_node_count) std::abort();
  if (all == 1e300) std::abort();  // keeps the sum from being left out
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto folder = std::filesystem::temp_directory_path() /
                             ("crowdface_fuzz_cache_" + std::to_string(::getpid()));
  const Digest key = {1, 2};
  std::string bytes(fuzz::text_of(data, size));
  std::filesystem::create_directories(folder);
  const auto write = [&](const CacheKey& entry_key) {
    constexpr std::size_t kKeyPlace = 16;
    if (bytes.size() >= kKeyPlace + 2 * sizeof(Digest)) {
      const Digest in_header = Hasher().add(entry_key.kind).add(entry_key.digest).digest();
      std::memcpy(bytes.data() + kKeyPlace, &in_header, sizeof in_header);
      const std::size_t content = bytes.size() - sizeof(Digest);
      const Digest sum = hash_bytes(std::string_view(bytes).substr(0, content));
      std::memcpy(bytes.data() + content, &sum, sizeof sum);
    }
    std::ofstream(cache_entry(folder, entry_key), std::ios::binary) << bytes;
  };
  for (const LevelRepresentation levels :
       {LevelRepresentation::kBasis, LevelRepresentation::kExact, LevelRepresentation::kCubic}) {
    const HeadCacheSizes shape = {8, 4, 3, 5, 60, levels};
    write(prepared_key(key));
    if (const auto head = find_prepared(folder, key, shape)) read_all(*head, shape);
  }
  write(key_of_read_head(key));
  ObjFile head;
  fill_head_from_cache(folder, key, head);
  write({"mesh", key});
  if (const auto mesh = find_mesh(folder, key)) build_adjacency(mesh->topology);
  return 0;
}
