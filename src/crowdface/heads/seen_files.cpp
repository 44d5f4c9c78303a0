// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/seen_files.h"

#include <cstring>
#include <ctime>
#include <type_traits>

#include <sys/stat.h>

#include "crowdface/core/error.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return time.tv_sec * kSecond + time.tv_nsec;
}

}  // namespace

std::optional<SeenFile::Stamp> SeenFile::stamp_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return Stamp{status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
               nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

SeenFile::SeenFile(const CacheFolder& cache, const fs::path& file) : file_(file) {
  static_assert(std::has_unique_object_representations_v<Stamp>);
  if (!cache.trusts_seen_files || cache.path.empty()) return;
  stamp_ = stamp_of(file);
  if (!stamp_) return;
  const Digest place = Hasher().add(stamp_->device).add(stamp_->inode).digest();
  entry_ = cache_entry(cache, place, kSeenEnding);
  try {
    const auto entry = map_entry(entry_);
    if (!entry || entry->content.size() != sizeof(Stamp) + sizeof(Digest)) return;
    Stamp seen;
    std::memcpy(&seen, entry->content.data(), sizeof seen);
    if (seen != *stamp_) return;
    digest_.emplace();
    std::memcpy(&*digest_, entry->content.data() + sizeof seen, sizeof *digest_);
  } catch (const RecoverableError&) {  // what is not kept well is not known
  }
}

void SeenFile::remember(const Digest& digest) const {
  if (!stamp_ || digest_ == digest || stamp_of(file_) != stamp_) return;
  // Clocks of file systems tick some hundred times a second.
  constexpr std::int64_t kSettled = 1'000'000'000;
  timespec now{};
  if (::clock_gettime(CLOCK_REALTIME, &now) != 0 ||
      nanoseconds(now) - stamp_->changed_ns < kSettled) {
    return;
  }
  try {
    write_entry(entry_, {bytes_of(&*stamp_, sizeof *stamp_), bytes_of(&digest, sizeof digest)});
  } catch (const RecoverableError&) {  // then it is read whole the next time too
  }
}

}  // namespace crowdface
