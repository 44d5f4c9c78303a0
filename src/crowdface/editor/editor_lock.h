// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "crowdface/core/file_lock.h"

namespace crowdface {

/// The right to be the one editor of a crowd, for as long as it lives; on all machines that share the
/// file system, and free again when its process is killed.
class EditorLock {
 public:
  /// \param folder  is there; takes the lock and, readable by its owner alone, the address.
  /// \throws UsageError, with the other's address, if there is another editor.
  explicit EditorLock(const std::filesystem::path& folder);
  ~EditorLock();
  EditorLock(const EditorLock&) = delete;
  EditorLock& operator=(const EditorLock&) = delete;

  /// For others to be told. \throws CannotCreate
  void tell(const std::string& address);

 private:
  std::filesystem::path address_;
  std::unique_ptr<FileLock> lock_;
};

}  // namespace crowdface
