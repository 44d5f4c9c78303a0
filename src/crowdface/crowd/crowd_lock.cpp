// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_lock.h"

#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

void remove_all_leftovers(const fs::path& root) {
  std::size_t removed = remove_leftovers(root);
  std::error_code error;
  for (fs::recursive_directory_iterator entry(root, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_directory(ignored)) removed += remove_leftovers(entry->path());
  }
  if (removed > 0) log_debug(concat(removed, " files that a killed run left half written removed"));
}

}  // namespace

CrowdLock::CrowdLock(const CrowdDirectory& directory, const Shard& shard) {
  make_directories(directory.root);
  const auto tell = [&](std::string_view who) {
    log_info(concat(directory.root.string(), ": ", who, " is at work there; waiting for it"));
  };
  crowd_ = std::make_unique<FileLock>(directory.lock(),
                                      shard.whole() ? LockKind::kExclusive : LockKind::kShared,
                                      [&] { tell("another run"); });
  if (!shard.whole()) {
    shard_ = std::make_unique<FileLock>(directory.lock(shard), LockKind::kExclusive,
                                        [&] { tell(concat("shard ", shard.name())); });
  }
  remove_all_leftovers(directory.root);
}

}  // namespace crowdface
