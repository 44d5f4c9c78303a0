// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace crowdface {

/// A new folder for temporary files. The destructor removes the folder and its content.
class ScratchFolder {
 public:
  /// \throws CannotCreate
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace crowdface
