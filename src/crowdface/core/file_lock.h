// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "crowdface/core/file_descriptor.h"

namespace crowdface {

/// Whether several processes may hold the lock at the same time.
enum class LockKind {
  kShared,     ///< other processes may hold shared locks at the same time
  kExclusive,  ///< no other process may hold a lock
};

/// A lock between processes (flock), also between processes on different machines that share a file
/// system. Held while the object lives. The kernel releases the lock when the process dies, so a
/// lock file that a killed process left behind locks nothing.
class FileLock {
 public:
  /// Waits until the lock is free.
  /// \param path        an empty file, created if it does not exist; its folder must exist.
  /// \param on_waiting  called once if the lock is not free; may be empty.
  /// \throws CannotCreate if the file cannot be created; IoError if it cannot be locked;
  ///         Interrupted if a signal arrives while waiting.
  FileLock(const std::filesystem::path& path, LockKind kind,
           const std::function<void()>& on_waiting);
  /// Removes the lock file unless another process holds a lock on it.
  ~FileLock();

 private:
  std::filesystem::path path_;  ///< path of the lock file
  FileDescriptor file_;         ///< the open lock file
};

}  // namespace crowdface
