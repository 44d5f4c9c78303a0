// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "crowdface/core/descriptor.h"

namespace crowdface {

/// Who may hold a lock at the same time.
enum class LockKind {
  kShared,     ///< others that share
  kExclusive,  ///< nobody else
};

/// Keeps others out for as long as it lives, on all machines that share the file system. The lock
/// belongs to the open file, not to the file's existence: one that a killed process left is no lock.
class FileLock {
 public:
  /// Waits until the lock is free.
  /// \param path     an empty file, created if it is not there, in a folder that is.
  /// \param waiting  called once if it has to wait; may be empty.
  /// \throws CannotCreate if the file cannot be made; IoError if it cannot be locked; Interrupted.
  FileLock(const std::filesystem::path& path, LockKind kind, const std::function<void()>& waiting);
  /// Removes the file, if nobody else holds a lock on it.
  ~FileLock();

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace crowdface
