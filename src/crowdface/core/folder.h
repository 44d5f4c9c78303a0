// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <system_error>
#include <vector>

#include "crowdface/core/file_descriptor.h"

namespace crowdface {

/// The entries of a folder, sorted by path; empty if the folder does not exist.
/// \param error  if not null, receives the error when the folder does not exist or access is
///               denied.
/// \throws IoError if the folder cannot be read completely. Denied access throws only if `error` is
///         null.
std::vector<std::filesystem::path> list_folder(const std::filesystem::path& folder,
                                               std::error_code* error = nullptr);

/// Like list_folder, but returns only the entries for which `is_wanted` is true. \throws IoError
/// like list_folder.
std::vector<std::filesystem::path> list_files(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& is_wanted,
    std::error_code* error = nullptr);

/// Predicate for list_files: the path's extension is `ending`, such as ".obj".
inline auto extension_filter(const char* ending) {
  return [ending](const std::filesystem::path& path) { return path.extension() == ending; };
}

/// Returns a folder and all its subfolders, each parent before its children. Symbolic links are not
/// followed.
/// \throws IoError like list_folder.
std::vector<std::filesystem::path> folder_tree(const std::filesystem::path& root);

/// Whether `path` is `folder` or lies inside it, after all links are resolved. The path need not
/// exist. Returns false if one of the paths cannot be resolved. \throws IoError on a system error
/// (disk, memory, too many open files).
bool is_inside_folder(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Keeps a directory open, so that a removal, rename or replacement of the directory can be
/// detected.
class DirectoryHandle {
 public:
  /// \throws CannotCreate if the folder cannot be opened, because then no output can be created in
  /// it.
  explicit DirectoryHandle(const std::filesystem::path& folder);
  /// Checks that the path still leads to the directory that this object opened: nobody has moved or
  /// replaced the directory.
  /// \throws IoError if the path leads elsewhere.
  void require_still_at_path() const;

 private:
  std::filesystem::path path_;
  FileDescriptor opened_;  ///< the directory that was at path_ at construction
};

}  // namespace crowdface
