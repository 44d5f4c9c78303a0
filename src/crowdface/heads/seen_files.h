// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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
  /// Device, inode, size, and the times of both changes in nanoseconds.
  using Stamp = std::array<std::int64_t, 5>;
  static std::optional<Stamp> stamp_of(const std::filesystem::path& file);

  std::filesystem::path file_, cache_;
  std::optional<Stamp> stamp_;
  std::optional<Digest> digest_;
};

}  // namespace crowdface
