// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <mutex>
#include <string_view>

#include "crowdface/core/descriptor.h"

namespace crowdface {

/// A file that only grows. What `append` has returned from survives a power cut; what it was at when
/// the process died may be there in part. Any thread may append.
class AppendFile {
 public:
  /// Creates the file if it is not there. \throws CannotCreate.
  explicit AppendFile(const std::filesystem::path& path);

  /// \throws IoError.
  void append(std::string_view bytes);

 private:
  std::filesystem::path path_;
  Descriptor file_;
  std::mutex mutex_;
};

}  // namespace crowdface
