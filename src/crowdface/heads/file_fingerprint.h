// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// Looks up the hash of a file in the cache, so that a file that has not changed since it was last
/// read need not be hashed again. Requires `CacheFolder::skips_hash_of_unchanged_files`. A file
/// counts as unchanged if device, inode, size, mtime and ctime are the same. (No program can set
/// the ctime.) Hashing gigabytes at every start would keep users of the editor waiting.
class FileFingerprint {
 public:
  /// \param cache  the cache that stores the fingerprints of files that were read before
  FileFingerprint(const CacheFolder& cache, const std::filesystem::path& file);

  /// The stored hash of the file's bytes. Empty if `CacheFolder::skips_hash_of_unchanged_files` is
  /// false, if the cache has no hash of this file, or if the file has changed since it was last
  /// read.
  const std::optional<Digest>& digest() const { return digest_; }
  /// Stores the hash of the file's bytes in the cache. The caller must construct this object before
  /// reading the file, and must call this function only if the bytes are valid. Stores nothing if
  /// `CacheFolder::skips_hash_of_unchanged_files` is false, or if the file has changed since the
  /// construction. Also stores nothing if the file was changed less than a second ago, because a
  /// further change might then leave mtime and ctime the same.
  void remember(const Digest& digest) const;

 private:
  /// Device, inode, size, and the times mtime and ctime in nanoseconds.
  using Stamp = std::array<std::int64_t, 5>;
  /// The present stamp of a file; nothing if the file system does not tell it.
  static std::optional<Stamp> stamp_of(const std::filesystem::path& file);

  std::filesystem::path file_, cache_;  ///< path of the file to look up; path of the cache folder
  std::optional<Stamp> stamp_;          ///< the file's stamp at the construction of this object
  /// the stored hash of the file's bytes; empty if there is none or the file has changed since
  std::optional<Digest> digest_;
};

}  // namespace crowdface
