// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/core/file_lock.h"
#include "crowdface/core/folder.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/shard.h"

namespace crowdface {

/// Holds the write lock of a crowd's folder during its lifetime. A run over the whole crowd
/// excludes all other runs. Runs of different shards can hold the lock at the same time; two runs
/// of the same shard cannot.
class CrowdLock {
 public:
  /// Creates the folder if necessary, and waits for the lock; logs a message if the lock is not
  /// free. Then removes the incomplete files of killed runs.
  /// \throws CannotCreate, IoError, Interrupted.
  CrowdLock(const CrowdDirectory& directory, const Shard& shard);

  /// Checks that the locked folder still has its path. Call this before a run reports success.
  /// \throws IoError if the folder was removed or replaced since the lock was taken.
  void require_same_folder() const { root_handle_->require_still_at_path(); }

 private:
  std::unique_ptr<DirectoryHandle> root_handle_;  ///< the crowd's folder
  /// lock of the whole crowd: exclusive for a run over the whole crowd, shared for a run of a shard
  std::unique_ptr<FileLock> crowd_lock_;
  /// lock of the shard; null if the run makes the whole crowd
  std::unique_ptr<FileLock> shard_lock_;
};

}  // namespace crowdface
