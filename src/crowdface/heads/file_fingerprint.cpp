// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/file_fingerprint.h"

#include <ctime>
#include <span>

#include <sys/stat.h>

#include "crowdface/core/error.h"
#include "crowdface/heads/cache_entry.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return time.tv_sec * kSecond + time.tv_nsec;
}

/// The key of the cache entry for a file. The file is identified by its device and inode.
CacheKey fingerprint_key(std::span<const std::int64_t> stamp) {
  return {"seen", Hasher().add(stamp[0]).add(stamp[1]).digest()};
}

}  // namespace

std::optional<FileFingerprint::Stamp> FileFingerprint::stamp_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return Stamp{static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino),
               status.st_size, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

FileFingerprint::FileFingerprint(const CacheFolder& cache, const fs::path& file)
    : file_(file), cache_(cache.path) {
  if (!cache.skips_hash_of_unchanged_files || cache.path.empty()) return;
  stamp_ = stamp_of(file);
  if (!stamp_) return;
  try {
    const auto entry = CacheEntry::open(cache_, fingerprint_key(*stamp_));
    if (!entry) return;
    const ArrayReader arrays(*entry);
    Stamp seen;
    Digest digest;
    arrays("stamp", seen);
    arrays("digest", digest);
    if (seen == *stamp_) digest_ = digest;
  } catch (const RecoverableError&) {  // ignore a damaged entry: the file will be hashed
  }
}

void FileFingerprint::remember(const Digest& digest) const {
  if (!stamp_ || digest_ == digest || stamp_of(file_) != stamp_) return;
  // A hash is stored only if the last change of the file is at least this many nanoseconds old.
  // File systems advance their time stamps only a few hundred times a second. A second change soon
  // after the first might leave the time stamps equal.
  constexpr std::int64_t kSettled = 1'000'000'000;
  timespec now{};
  if (::clock_gettime(CLOCK_REALTIME, &now) != 0 || nanoseconds(now) - stamp_->back() < kSettled) {
    return;
  }
  try {
    ArrayWriter arrays;
    arrays("stamp", *stamp_);
    arrays("digest", digest);
    write_entry(cache_, fingerprint_key(*stamp_), arrays.arrays);
  } catch (const RecoverableError&) {  // the next run will hash the file again
  }
}

}  // namespace crowdface
