// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_lock.h"

#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {
CrowdLock::CrowdLock(const CrowdDirectory& directory, const Shard& shard) {
  make_directories(directory.root);
  root_handle_ = std::make_unique<DirectoryHandle>(directory.root);
  const auto tell = [&](std::string_view who) {
    log_info(concat(directory.root.string(), ": ", who, " is using this folder; waiting for it"));
  };
  crowd_lock_ = std::make_unique<FileLock>(
      directory.lock(), shard.is_whole_crowd() ? LockKind::kExclusive : LockKind::kShared,
      [&] { tell("another run"); });
  if (!shard.is_whole_crowd()) {
    shard_lock_ = std::make_unique<FileLock>(directory.lock(shard), LockKind::kExclusive,
                                             [&] { tell(concat("shard ", shard.name())); });
  }
  std::size_t removed = 0;
  for (const auto& folder : folder_tree(directory.root)) removed += remove_temporary_files(folder);
  if (removed > 0) log_debug(concat("removed ", removed, " incomplete files of a killed run"));
}

}  // namespace crowdface
