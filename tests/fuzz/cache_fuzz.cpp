// SPDX-License-Identifier: Apache-2.0
// An entry's checksum would stop the fuzzer at once, so the input gets the right one at its end.
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
  Digest sum;
  if (bytes.size() >= sizeof sum) {
    sum = hash_bytes(std::string_view(bytes).substr(0, bytes.size() - sizeof sum));
    std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
  }
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::filesystem::path& entry) {
    std::ofstream(entry, std::ios::binary) << bytes;
  };
  write(cache_entry(folder, key, kPreparedEnding));
  for (const Levels levels : {Levels::kBasis, Levels::kExact, Levels::kCubic}) {
    const HeadCacheShape shape = {8, 4, 3, 5, 60, levels};
    try {
      if (const auto head = read_cached_head(folder, key, shape)) read_all(*head, shape);
    } catch (const RecoverableError&) {
    }
  }
  write(head_entry(folder, key));
  write(mesh_entry(folder, key));
  try {
    ObjFile head;
    find_head(folder, key, head);
  } catch (const RecoverableError&) {
  }
  try {
    if (const auto mesh = find_mesh(folder, key)) build_adjacency(mesh->topology);
  } catch (const RecoverableError&) {
  }
  return 0;
}
