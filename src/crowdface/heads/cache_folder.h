// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"

namespace crowdface {

/// Where heads are kept, as read and prepared, unless `--cache` says otherwise:
/// $XDG_CACHE_HOME/crowdface, else ~/.cache/crowdface, else a folder for temporary files.
std::filesystem::path cache_directory();

/// A cache and how its files are read.
struct CacheFolder {
  std::filesystem::path path;  ///< empty: nothing is kept
  /// Whether heads' texts and entries of the cache are taken for what they were when they were last read whole, if
  /// nobody has written to them since: see SeenFile.
  bool trusts_seen_files = false;

  CacheFolder() = default;
  CacheFolder(std::filesystem::path folder) : path(std::move(folder)) {}  // NOLINT(*-explicit-*)
  operator const std::filesystem::path&() const { return path; }          // NOLINT(*-explicit-*)
};

/// The endings of the cache's files; docs/cache-format.md specifies their bytes.
inline constexpr std::string_view kPreparedEnding = ".cfhead", kReadEnding = ".cfread",
                                  kMeshEnding = ".cfmesh";
inline constexpr std::string_view kListsEnding = ".cflist";  ///< what was found of heads
inline constexpr std::string_view kSeenEnding = ".cfseen";   ///< when a file was read whole

/// The file of an entry: its key in hexadecimal, and an ending.
std::filesystem::path cache_entry(const std::filesystem::path& cache, const Digest& key,
                                  std::string_view ending);

/// The entries of a cache and their sizes.
struct CacheContents {
  std::vector<std::filesystem::path> entries;
  std::size_t prepared = 0;  ///< heads
  std::size_t read = 0;      ///< heads
  std::uintmax_t bytes = 0;
};
CacheContents list_cache(const std::filesystem::path& cache);

/// Removes all entries (and nothing else) of the cache. \return how many.
std::size_t clear_cache(const std::filesystem::path& cache);

/// An entry as it was written, mapped.
struct MappedEntry {
  std::shared_ptr<const MappedFile> file;
  std::string_view content;  ///< all but the checksum that ends it
  Digest sum;                ///< that checksum
};

/// \param known  the checksum, if its bytes are known to have it; otherwise they are hashed.
/// \return nothing if there is none. \throws InvalidInput if its checksum does not hold.
std::optional<MappedEntry> map_entry(const std::filesystem::path& path,
                                     const std::optional<Digest>& known = {});

/// Writes the pieces one after the other, and their checksum. \throws CannotCreate, IoError.
void write_entry(const std::filesystem::path& path, std::vector<std::string_view> pieces);

/// What to say of an entry: "PATH: cache entry is …".
InvalidInput bad_entry(const std::filesystem::path& path, std::string_view what);

/// Whether all numbers are finite, and none larger than coordinates of a mesh may be, with room for
/// what smoothing makes of them.
bool are_coordinates(std::span<const float> values);
bool are_coordinates(std::span<const double> values);

/// Whether all numbers are below `end`; in `are_rows` some may be kNoIndex, too.
bool all_below(std::span<const std::uint32_t> numbers, std::uint64_t end);
bool are_rows(std::span<const std::uint32_t> numbers, std::uint64_t end);
bool all_finite(std::span<const float> numbers);

/// The bytes of an object or a list, for `write_entry`.
inline std::string_view bytes_of(const void* data, std::size_t size) {
  return {static_cast<const char*>(data), size};
}
template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return bytes_of(values.data(), values.size_bytes());
}

}  // namespace crowdface
