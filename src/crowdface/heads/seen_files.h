// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// A file that is about to be read whole: what is known of it from the last time, if the cache trusts seen files and
/// nobody has written to the file since: as told by device, inode, size, and the times of the last change of the bytes
/// and of the file (ctime, which no program can set). Then gigabytes need not be hashed before a page opens.
class SeenFile {
 public:
  /// \param cache  in whose folder it is kept what was seen.
  SeenFile(const CacheFolder& cache, const std::filesystem::path& file);

  /// The hash of its bytes, if files are trusted and this one has not changed since.
  const std::optional<Digest>& digest() const { return digest_; }
  /// Keeps the hash of the bytes that were read since this object was made, and found to be sound. Does
  /// nothing unless files are trusted; nor where the file has changed meanwhile, or so lately that a further
  /// change might not show.
  void remember(const Digest& digest) const;

 private:
  struct Stamp {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t modified_ns = 0, changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  static std::optional<Stamp> stamp_of(const std::filesystem::path& file);

  std::filesystem::path file_, entry_;
  std::optional<Stamp> stamp_;
  std::optional<Digest> digest_;
};

}  // namespace crowdface
