// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <mutex>
#include <string_view>

#include "crowdface/core/file_descriptor.h"

namespace crowdface {

/// A file to which the program only appends. After `append` has returned, the appended bytes
/// survive a power cut. If the process dies during `append`, the file may have only some of the
/// bytes. Thread-safe.
class AppendFile {
 public:
  /// Creates the file if it does not exist. \throws CannotCreate.
  explicit AppendFile(const std::filesystem::path& path);

  /// Appends the bytes and syncs the file.
  /// \throws IoError.
  void append(std::string_view bytes);

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  std::mutex mutex_;  ///< lets one thread append at a time
};

}  // namespace crowdface
