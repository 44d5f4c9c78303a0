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
void read_all(const PreparedHead& head, const HeadCacheShape& shape) {
  double all = 0;
  const LevelFields& fields = head.levels.fields;
  for (Index p = 0; p < fields.rank; ++p) {
    for (Index v = 0; v < fields.vertex_count; ++v) all += fields.value(p, v, 0);
  }
  for (const std::int16_t number : fields.numbers) all += number;
  all += head.levels.mixing.sum() + head.trajectory.sum();
  if (fields.rank > shape.nodes) std::abort();
  if (all == 1e300) std::abort();  // keeps the sum from being left out
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto folder = std::filesystem::temp_directory_path() /
                             ("crowdface_fuzz_cache_" + std::to_string(::getpid()));
  const Digest key = {1, 2};
  std::string bytes(fuzz::text_of(data, size));
  std::filesystem::create_directories(folder);
  const auto with_entry = [&](const CacheKey& entry_key, const auto& read) {
    constexpr std::size_t kKeyPlace = 16;
    if (bytes.size() >= kKeyPlace + 2 * sizeof(Digest)) {
      const Digest in_header = Hasher().add(entry_key.kind).add(entry_key.digest).digest();
      std::memcpy(bytes.data() + kKeyPlace, &in_header, sizeof in_header);
      const std::size_t content = bytes.size() - sizeof(Digest);
      const Digest sum = hash_bytes(std::string_view(bytes).substr(0, content));
      std::memcpy(bytes.data() + content, &sum, sizeof sum);
    }
    std::ofstream(cache_entry(folder, entry_key), std::ios::binary) << bytes;
    try {
      if (const auto entry = CacheEntry::open(folder, entry_key)) read(*entry);
    } catch (const RecoverableError&) {
    }
  };
  for (const Levels levels : {Levels::kBasis, Levels::kExact, Levels::kCubic}) {
    const HeadCacheShape shape = {8, 4, 3, 5, 60, levels};
    with_entry(prepared_key(key), [&](const CacheEntry& entry) {
      read_all(prepared_head(entry, shape), shape);
      return 0;
    });
  }
  with_entry(read_key(key), [](const CacheEntry& entry) {
    ObjFile head;
    return read_head(entry, head).low;
  });
  with_entry(mesh_key(key), [&](const CacheEntry& entry) {
    return build_adjacency(read_mesh(entry, key).topology).group_count();
  });
  return 0;
}
