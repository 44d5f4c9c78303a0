// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cache_folder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::array kEndings = {kPreparedEnding, kReadEnding, kMeshEnding, kListsEnding,
                                 kSeenEnding};

/// Magnitudes are ordered as their bits are, and NaN and infinity beyond all others. So they are
/// compared as integers, vectors of them at once: any too large makes its difference negative.
template <class Integer, class T>
bool all_coordinates(std::span<const T> values) {
  constexpr auto kMagnitude = std::numeric_limits<Integer>::max();
  constexpr auto kLargest = std::bit_cast<Integer>(T{1e9});
  Integer differences = 0;
  for (const T value : values) {
    differences |= kLargest - (std::bit_cast<Integer>(value) & kMagnitude);
  }
  return differences >= 0;
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

fs::path cache_entry(const fs::path& cache, const Digest& key, std::string_view ending) {
  return cache / concat(key.hex(), ending);
}

CacheContents list_cache(const fs::path& cache) {
  std::error_code error, ignored;
  CacheContents contents;
  contents.entries = list_files(
      cache,
      [&](const fs::path& path) {
        return std::ranges::find(kEndings, path.extension().string()) != kEndings.end() &&
               is_file(path);
      },
      &error);
  if (error && error != std::errc::no_such_file_or_directory) {
    throw MissingInput(concat(cache.string(), ": cannot be read as a folder: ", error.message()));
  }
  for (const fs::path& entry : contents.entries) {
    contents.bytes += fs::file_size(entry, ignored);
    contents.prepared += entry.extension() == kPreparedEnding ? 1U : 0U;
    contents.read += entry.extension() == kReadEnding ? 1U : 0U;
  }
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

std::optional<MappedEntry> map_entry(const fs::path& path, const std::optional<Digest>& known) {
  if (!is_there(path)) return std::nullopt;
  const auto file = std::make_shared<const MappedFile>(path, WhenCut::kFill);
  if (file->bytes().size() < sizeof(Digest)) throw bad_entry(path, "of the wrong size");
  const std::size_t size = file->bytes().size() - sizeof(Digest);
  const std::string_view content = file->bytes().substr(0, size);
  const Digest sum = known ? *known : hash_bytes(content);
  if (file->bytes().substr(size) != bytes_of(&sum, sizeof sum)) {
    throw bad_entry(path, "damaged (its checksum is wrong)");
  }
  return MappedEntry{file, content, sum};
}

void write_entry(const fs::path& path, std::vector<std::string_view> pieces) {
  make_directories(path.parent_path());
  Hasher hasher;
  for (const std::string_view piece : pieces) hasher.add_raw(piece);
  const Digest sum = hasher.digest();
  pieces.push_back(bytes_of(&sum, sizeof sum));
  write_file(path, pieces);
}

InvalidInput bad_entry(const fs::path& path, std::string_view what) {
  return InvalidInput(concat(path.string(), ": cache entry is ", what));
}

bool all_below(std::span<const std::uint32_t> numbers, std::uint64_t end) {
  return std::ranges::all_of(numbers, [&](std::uint32_t number) { return number < end; });
}

bool all_finite(std::span<const float> numbers) {
  return std::ranges::all_of(numbers, [](float value) { return std::isfinite(value); });
}

bool are_rows(std::span<const std::uint32_t> numbers, std::uint64_t end) {
  return std::ranges::all_of(
      numbers, [&](std::uint32_t number) { return number < end || number == kNoIndex; });
}

bool are_coordinates(std::span<const float> values) {
  return all_coordinates<std::int32_t>(values);
}

bool are_coordinates(std::span<const double> values) {
  return all_coordinates<std::int64_t>(values);
}

}  // namespace crowdface
