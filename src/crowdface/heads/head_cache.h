// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/prepared.h"

namespace crowdface {

/// Where prepared heads are kept unless `--cache` says otherwise: $XDG_CACHE_HOME/crowdface, else
/// ~/.cache/crowdface, else a folder for temporary files.
std::filesystem::path cache_directory();

/// What an entry must hold to be of use.
struct HeadCacheShape {
  Index vertices = 0;
  Index samples = 0;
  Index trajectory_levels = 0;  ///< rows of the trajectory
  Index nodes = 0;              ///< of `levels: basis`
  std::uint64_t max_level = 0;
  Levels levels = Levels::kBasis;
};

/// The file of a head's entry: its key in hexadecimal and ".cfhead". docs/cache-format.md specifies
/// the bytes.
std::filesystem::path cache_entry(const std::filesystem::path& cache, const Digest& key);

/// Reads an entry, whose fields stay in the file, mapped. \return nothing if there is none.
/// \throws InvalidInput if it is damaged, of another version or of another shape.
std::optional<PreparedHead> read_cached_head(const std::filesystem::path& cache, const Digest& key,
                                             const HeadCacheShape& shape);

/// Writes an entry. \throws CannotCreate, IoError.
void write_cached_head(const std::filesystem::path& cache, const Digest& key,
                       const HeadCacheShape& shape, const PreparedHead& head);

/// The entries of a cache and their sizes.
struct CacheContents {
  std::vector<std::filesystem::path> entries;
  std::uintmax_t bytes = 0;
};
CacheContents list_cache(const std::filesystem::path& cache);

/// Removes all entries (and nothing else) of the cache. \return how many.
std::size_t clear_cache(const std::filesystem::path& cache);

}  // namespace crowdface
