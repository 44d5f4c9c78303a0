// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

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

/// The kinds of entries that `list_cache` counts, see CacheKey.
inline constexpr std::string_view kPreparedKind = "prepared", kReadKind = "read";

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

}  // namespace crowdface
