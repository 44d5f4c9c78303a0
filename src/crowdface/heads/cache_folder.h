// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace crowdface {

/// The cache folder that is used without the option `--cache`. If $XDG_CACHE_HOME is set,
/// $XDG_CACHE_HOME/crowdface. Otherwise, if $HOME is set, ~/.cache/crowdface. Otherwise, a folder
/// for temporary files.
std::filesystem::path cache_directory();

/// A cache folder, and whether unchanged files are accepted without being hashed again.
struct CacheFolder {
  std::filesystem::path path;  ///< path of the folder; empty: no cache
  /// Whether a head file or cache entry is accepted without hashing if it was read completely
  /// before and has not been written to since (see FileFingerprint).
  bool skips_hash_of_unchanged_files = false;

  CacheFolder() = default;
  CacheFolder(std::filesystem::path folder) : path(std::move(folder)) {}  // NOLINT(*-explicit-*)
  operator const std::filesystem::path&() const { return path; }          // NOLINT(*-explicit-*)
};

/// The kinds of cache entries (see CacheKey) that `list_cache` counts: prepared heads and read
/// heads.
inline constexpr std::string_view kPreparedKind = "prepared", kReadKind = "read";

/// The entries of a cache, their number and their total size.
struct CacheContents {
  std::vector<std::filesystem::path> entries;  ///< paths of the entries' files
  std::size_t prepared_head_count = 0;         ///< number of entries with a prepared head
  std::size_t loaded_head_count = 0;           ///< number of entries with the parsed file of a head
  std::uintmax_t bytes = 0;                    ///< total size of all entries
};
/// Lists the entries of a cache folder. A folder that does not exist counts as empty.
/// \throws MissingInput if the folder cannot be read.
CacheContents list_cache(const std::filesystem::path& cache);

/// Removes all entries of a cache folder, and the temporary files that killed runs left. Removes no
/// other file.
/// \return the number of removed entries and temporary files.
std::size_t clear_cache(const std::filesystem::path& cache);

}  // namespace crowdface
