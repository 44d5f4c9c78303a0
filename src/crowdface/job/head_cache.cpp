// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/head_cache.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".cfhead";

/// The first 72 bytes of an entry, little-endian.
struct Header {
  char magic[8] = {'C', 'F', 'H', 'E', 'A', 'D', '\r', '\n'};
  std::uint32_t version = 1;
  std::uint32_t rank = 0;  ///< fields that follow the trajectory
  std::uint64_t key_high = 0, key_low = 0;
  std::uint64_t vertices = 0;  ///< rows of a field; 0 if rank is 0
  std::uint64_t samples = 0;
  std::uint64_t levels = 0;
  std::uint64_t max_level = 0;
  std::uint64_t reserved = 0;
};
static_assert(sizeof(Header) == 72);

std::string_view bytes_of(const void* data, std::size_t size) {
  return {static_cast<const char*>(data), size};
}

std::size_t payload_floats(const Header& header) {
  return 3 * (header.samples * header.levels + header.vertices * header.rank);
}

void take(std::string_view& bytes, float* to, Index count) {
  const std::size_t size = static_cast<std::size_t>(count) * sizeof(float);
  std::memcpy(to, bytes.data(), size);
  bytes.remove_prefix(size);
}

}  // namespace

fs::path cache_directory() {
  const auto from = [](const char* variable) -> std::string {
    const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): read at start only
    return value == nullptr ? std::string() : std::string(value);
  };
  if (const std::string xdg = from("XDG_CACHE_HOME"); !xdg.empty())
    return fs::path(xdg) / "crowdface";
  if (const std::string home = from("HOME"); !home.empty()) {
    return fs::path(home) / ".cache" / "crowdface";
  }
  return fs::temp_directory_path() / "crowdface-cache";
}

fs::path cache_entry(const fs::path& cache, const Digest& key) {
  return cache / concat(key.hex(), kEnding);
}

std::optional<PreparedHead> read_cached_head(const fs::path& cache, const Digest& key,
                                             const HeadCacheShape& shape) {
  const fs::path path = cache_entry(cache, key);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  const MappedFile file(path);
  std::string_view bytes = file.bytes();
  const auto damaged = [&](std::string_view what) {
    return InvalidInput(concat(path.string(), ": cache entry is ", what));
  };
  Header expected;
  expected.rank = shape.fitted ? CubicFit::kRank : 0;
  expected.key_high = key.high;
  expected.key_low = key.low;
  expected.vertices = shape.fitted ? static_cast<std::uint64_t>(shape.vertices) : 0;
  expected.samples = static_cast<std::uint64_t>(shape.samples);
  expected.levels = static_cast<std::uint64_t>(shape.levels);
  expected.max_level = shape.max_level;
  const std::size_t size =
      sizeof(Header) + payload_floats(expected) * sizeof(float) + sizeof(Digest);
  if (bytes.size() != size) throw damaged("of the wrong size");
  if (std::memcmp(bytes.data(), &expected, sizeof expected) != 0) {
    throw damaged("of another version or for other data");
  }
  const Digest sum = hash_bytes(bytes.substr(0, size - sizeof(Digest)));
  if (std::memcmp(bytes.data() + size - sizeof sum, &sum, sizeof sum) != 0) {
    throw damaged("damaged (its checksum is wrong)");
  }
  bytes.remove_prefix(sizeof(Header));
  PreparedHead head;
  head.max_level = shape.max_level;
  head.trajectory.resize(shape.levels, 3 * shape.samples);
  take(bytes, head.trajectory.data(), head.trajectory.size());
  if (shape.fitted) {
    head.fit.emplace();
    head.fit->max_level = shape.max_level;
    for (CubicFit::Field& field : head.fit->fields) {
      field.resize(shape.vertices, 3);
      take(bytes, field.data(), field.size());
    }
  }
  return head;
}

void write_cached_head(const fs::path& cache, const Digest& key, const PreparedHead& head) {
  make_directories(cache);
  Header header;
  header.key_high = key.high;
  header.key_low = key.low;
  header.samples = static_cast<std::uint64_t>(head.trajectory.cols() / 3);
  header.levels = static_cast<std::uint64_t>(head.trajectory.rows());
  header.max_level = head.max_level;
  std::vector<std::string_view> pieces = {
      {},
      bytes_of(head.trajectory.data(),
               sizeof(float) * static_cast<std::size_t>(head.trajectory.size()))};
  if (head.fit) {
    header.rank = CubicFit::kRank;
    header.vertices = static_cast<std::uint64_t>(head.fit->fields[0].rows());
    for (const CubicFit::Field& field : head.fit->fields) {
      pieces.push_back(
          bytes_of(field.data(), sizeof(float) * static_cast<std::size_t>(field.size())));
    }
  }
  pieces[0] = bytes_of(&header, sizeof header);
  Hasher hasher;
  for (const std::string_view piece : pieces) hasher.add_raw(piece);
  const Digest sum = hasher.digest();
  pieces.push_back(bytes_of(&sum, sizeof sum));
  write_file(cache_entry(cache, key), pieces);
}

CacheContents list_cache(const fs::path& cache) {
  CacheContents contents;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(cache, ignored)) {
    if (entry.path().extension() != kEnding || !entry.is_regular_file(ignored)) continue;
    contents.entries.push_back(entry.path());
    contents.bytes += entry.file_size(ignored);
  }
  std::sort(contents.entries.begin(), contents.entries.end());
  return contents;
}

std::size_t clear_cache(const fs::path& cache) {
  std::size_t removed = 0;
  for (const fs::path& entry : list_cache(cache).entries) {
    std::error_code error;
    if (fs::remove(entry, error)) ++removed;
    if (error) throw IoError(concat(entry.string(), ": cannot be removed: ", error.message()));
  }
  return removed;
}

}  // namespace crowdface
