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

/// Receives the files that the user drops on the page. The files arrive in pieces in a hidden
/// folder; complete files move to a new folder `added/NAME` beside the config. No existing file
/// changes. Thread-safe.
class DroppedFiles {
 public:
  /// \param folder  the config's folder
  explicit DroppedFiles(const std::filesystem::path& folder);
  /// Deletes all received files that move_to_config_folder has not moved.
  ~DroppedFiles();
  DroppedFiles(const DroppedFiles&) = delete;
  DroppedFiles& operator=(const DroppedFiles&) = delete;

  /// Discards the files of an earlier upload and begins a new upload.
  /// \param sizes  size in bytes of each file, by name
  /// \throws UsageError if a name is unsafe, there is no mesh, or the files are too large.
  void begin_upload(const std::map<std::string, std::uint64_t>& sizes);
  /// Appends the next piece to a file of the upload.
  /// \param offset  number of bytes of the file before this piece
  /// \throws UsageError if an earlier piece is missing, or the file would become larger than its
  /// size in `begin_upload`.
  void add(const std::string& name, std::uint64_t offset, std::string_view bytes);
  /// Moves all files of the upload to a new folder `added/NAME` in the config's folder. NAME is the
  /// name of the first mesh file, if necessary with a number.
  /// \return paths of the mesh files, sorted by name.
  /// \throws UsageError if a file is incomplete.
  std::vector<std::filesystem::path> move_to_config_folder();

 private:
  /// Deletes the files of the current upload.
  void discard();

  std::filesystem::path added_folder_;  ///< the folder `added` in the config's folder
  /// hidden folder in `added_folder_` that receives the files
  std::filesystem::path upload_folder_;
  std::mutex mutex_;
  /// for the name of each file: the size of the file, and the number of bytes received so far
  std::map<std::string, std::uint64_t> expected_bytes_, received_bytes_;
};

}  // namespace crowdface
