// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Files that the user drops on the page. They arrive in pieces in a hidden folder and move, once
/// complete, to a new folder `added/NAME` beside the config. No existing file changes. Thread-safe.
class DroppedFiles {
 public:
  /// \param folder  the config's folder
  explicit DroppedFiles(const std::filesystem::path& folder);
  /// Removes files that were not kept.
  ~DroppedFiles();
  DroppedFiles(const DroppedFiles&) = delete;
  DroppedFiles& operator=(const DroppedFiles&) = delete;

  /// Begins anew. \param sizes  size in bytes of each file, by name
  /// \throws UsageError if a name is unsafe, there is no mesh, or the files are too large.
  void begin(const std::map<std::string, std::uint64_t>& sizes);
  /// Adds the next piece of a file.
  /// \param offset  bytes before the piece
  /// \throws UsageError if another piece is missing, or the file would become larger than its size
  /// in `begin`.
  void add(const std::string& name, std::uint64_t offset, std::string_view bytes);
  /// Moves all files to a new folder. \return the meshes, in the order of their names.
  /// \throws UsageError if a file is incomplete.
  std::vector<std::filesystem::path> keep();

 private:
  void forget();

  std::filesystem::path added_, arriving_;
  std::mutex mutex_;
  std::map<std::string, std::uint64_t> sizes_, arrived_;
};

}  // namespace crowdface
