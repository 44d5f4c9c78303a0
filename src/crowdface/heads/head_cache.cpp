// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_cache.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/list_files.h"
#include "crowdface/core/text.h"
#include "crowdface/smooth/cubic_fit.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".cfhead";

/// The first 128 bytes of an entry, little-endian.
struct Header {
  char magic[8] = {'C', 'F', 'H', 'E', 'A', 'D', '\r', '\n'};
  std::uint32_t version = 2;
  std::uint32_t levels = 0;  ///< how they are represented, see code_of
  std::uint64_t key_high = 0, key_low = 0;
  std::uint64_t vertices = 0;  ///< rows of a field; 0 if rank is 0
  std::uint64_t samples = 0;
  std::uint64_t trajectory_levels = 0;
  std::uint64_t max_level = 0;
  std::uint64_t nodes = 0;  ///< rows of the mixing; 0 unless `levels: basis`
  std::uint64_t rank = 0;   ///< fields
  double error_max = 0, error_rms = 0;
  std::uint64_t error_level = 0;
  std::uint64_t reserved[3] = {};
};
static_assert(sizeof(Header) == 128);

std::uint32_t code_of(Levels levels) {
  switch (levels) {
    case Levels::kExact:
      return 0;
    case Levels::kCubic:
      return 1;
    case Levels::kBasis:
      break;
  }
  return 2;
}

/// Where the parts of an entry begin: header, mixing, trajectory, fields (at a multiple of 64, so
/// that they can be used where they lie), checksum.
struct Places {
  explicit Places(const Header& header)
      : trajectory(sizeof(Header) + header.nodes * header.rank * sizeof(double)),
        fields((trajectory + 3 * header.samples * header.trajectory_levels * sizeof(float) + 63) /
               64 * 64),
        checksum(fields + 3 * header.vertices * header.rank * sizeof(float)),
        end(checksum + sizeof(Digest)) {}
  std::size_t trajectory, fields, checksum, end;
};

/// Finite, and within what coordinates of a mesh may be, with room for what smoothing makes of them.
bool all_usable(std::span<const float> values) {
  constexpr float kLargest = 1e9F;
  return std::all_of(values.begin(), values.end(),
                     [](float value) { return std::abs(value) <= kLargest; });
}

std::string_view bytes_of(const void* data, std::size_t size) {
  return {static_cast<const char*>(data), size};
}

/// What the header of an entry of this shape must be, but for what the fit decided.
Header header_of(const Digest& key, const HeadCacheShape& shape) {
  Header header;
  header.levels = code_of(shape.levels);
  header.key_high = key.high;
  header.key_low = key.low;
  if (shape.levels != Levels::kExact) header.vertices = static_cast<std::uint64_t>(shape.vertices);
  header.samples = static_cast<std::uint64_t>(shape.samples);
  header.trajectory_levels = static_cast<std::uint64_t>(shape.trajectory_levels);
  header.max_level = shape.max_level;
  if (shape.levels == Levels::kBasis) header.nodes = static_cast<std::uint64_t>(shape.nodes);
  if (shape.levels == Levels::kCubic) header.rank = CubicFit::kRank;
  return header;
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
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);  // one that is not there is an error
  return (error ? fs::path("/tmp") : temporary) / "crowdface-cache";
}

fs::path cache_entry(const fs::path& cache, const Digest& key) {
  return cache / concat(key.hex(), kEnding);
}

std::optional<PreparedHead> read_cached_head(const fs::path& cache, const Digest& key,
                                             const HeadCacheShape& shape) {
  const fs::path path = cache_entry(cache, key);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  const auto file = std::make_shared<const MappedFile>(path, WhenCut::kFill);
  const std::string_view bytes = file->bytes();
  const auto damaged = [&](std::string_view what) {
    return InvalidInput(concat(path.string(), ": cache entry is ", what));
  };
  Header header, expected = header_of(key, shape);
  if (bytes.size() < sizeof header) throw damaged("of the wrong size");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (shape.levels == Levels::kBasis) {  // what the fit decided is not known beforehand
    expected.rank = std::min(header.rank, header.nodes);
    expected.error_max = header.error_max;
    expected.error_rms = header.error_rms;
    expected.error_level = header.error_level;
  }
  if (bytes.substr(0, sizeof expected) != bytes_of(&expected, sizeof expected)) {
    throw damaged("of another version or for other data");
  }
  const Places places(header);
  if (bytes.size() != places.end) throw damaged("of the wrong size");
  const Digest sum = hash_bytes(bytes.substr(0, places.checksum));
  if (std::memcmp(bytes.data() + places.checksum, &sum, sizeof sum) != 0) {
    throw damaged("damaged (its checksum is wrong)");
  }
  PreparedHead head;
  head.max_level = shape.max_level;
  head.trajectory.resize(shape.trajectory_levels, 3 * shape.samples);
  if (head.trajectory.size() > 0) {
    std::memcpy(head.trajectory.data(), bytes.data() + places.trajectory,
                static_cast<std::size_t>(head.trajectory.size()) * sizeof(float));
  }
  StoredLevels& levels = head.levels;
  levels.rank = static_cast<Index>(header.rank);
  levels.error = {header.error_max, header.error_rms, header.error_level};
  levels.mixing.resize(static_cast<Index>(header.nodes), header.nodes == 0 ? 0 : levels.rank);
  if (levels.mixing.size() > 0) {
    std::memcpy(levels.mixing.data(), bytes.data() + sizeof header,
                static_cast<std::size_t>(levels.mixing.size()) * sizeof(double));
  }
  // The file is mapped at a page and the fields stand at a multiple of 64.
  levels.fields = {reinterpret_cast<const float*>(bytes.data() + places.fields),
                   static_cast<std::size_t>(3 * header.vertices * header.rank)};
  levels.mapped = file;
  // A checksum tells damage from what was written, not what was written from anything else.
  if (!levels.mixing.allFinite() || !all_usable(levels.fields) ||
      !all_usable({head.trajectory.data(), static_cast<std::size_t>(head.trajectory.size())})) {
    throw damaged("damaged (it holds numbers that no head has)");
  }
  if (file->was_cut()) throw damaged("being cut");
  return head;
}

void write_cached_head(const fs::path& cache, const Digest& key, const HeadCacheShape& shape,
                       const PreparedHead& head) {
  make_directories(cache);
  const StoredLevels& levels = head.levels;
  Header header = header_of(key, shape);
  header.rank = static_cast<std::uint64_t>(levels.rank);
  header.error_max = levels.error.max;
  header.error_rms = levels.error.rms;
  header.error_level = levels.error.level;
  const Places places(header);
  const std::string padding(places.fields - places.trajectory -
                                static_cast<std::size_t>(head.trajectory.size()) * sizeof(float),
                            '\0');
  std::vector<std::string_view> pieces = {
      bytes_of(&header, sizeof header),
      bytes_of(levels.mixing.data(),
               static_cast<std::size_t>(levels.mixing.size()) * sizeof(double)),
      bytes_of(head.trajectory.data(),
               static_cast<std::size_t>(head.trajectory.size()) * sizeof(float)),
      padding, bytes_of(levels.fields.data(), levels.fields.size_bytes())};
  Hasher hasher;
  for (const std::string_view piece : pieces) hasher.add_raw(piece);
  const Digest sum = hasher.digest();
  pieces.push_back(bytes_of(&sum, sizeof sum));
  write_file(cache_entry(cache, key), pieces);
}

CacheContents list_cache(const fs::path& cache) {
  std::error_code error, ignored;
  CacheContents contents;
  contents.entries = list_files(
      cache,
      [&](const fs::path& path) {
        return path.extension() == kEnding && fs::is_regular_file(path, ignored);
      },
      &error);
  if (error && error != std::errc::no_such_file_or_directory) {
    throw MissingInput(concat(cache.string(), ": cannot be read as a folder: ", error.message()));
  }
  for (const fs::path& entry : contents.entries) contents.bytes += fs::file_size(entry, ignored);
  return contents;
}

std::size_t clear_cache(const fs::path& cache) {
  std::size_t removed = remove_leftovers(cache);
  for (const fs::path& entry : list_cache(cache).entries) {
    std::error_code error;
    if (fs::remove(entry, error)) ++removed;
    if (error) throw IoError(concat(entry.string(), ": cannot be removed: ", error.message()));
  }
  return removed;
}

}  // namespace crowdface
