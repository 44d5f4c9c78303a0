// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/core/file_lock.h"
#include "crowdface/core/folder.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/shard.h"

namespace crowdface {

/// The right to write into a crowd's folder, for as long as it lives. A run over the whole crowd has
/// it alone; shards have it together, but each shard once.
class CrowdLock {
 public:
  /// Creates the folder if need be and waits for its turn, saying so. Then removes what killed runs
  /// left half written. \throws CannotCreate, IoError, Interrupted.
  CrowdLock(const CrowdDirectory& directory, const Shard& shard);

  /// To be asked before a run says that it is done. \throws IoError if the folder was removed or
  /// replaced since.
  void require_still_there() const { root_->require_same(); }

 private:
  std::unique_ptr<HeldFolder> root_;
  std::unique_ptr<FileLock> crowd_, shard_;
};

}  // namespace crowdface
