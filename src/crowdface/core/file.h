// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/hash.h"

namespace crowdface {

/// Like `std::filesystem::exists`, `is_directory` and `is_regular_file`, but return false for a
/// path that cannot be resolved: a folder without search permission, a cycle of links, a name that
/// is too long.
/// \throws IoError on a system error (disk, memory, too many open files), because such an error
/// does not tell whether the path exists.
bool path_exists(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
bool is_file(const std::filesystem::path& path);
/// Removes a file or an empty folder. Ignores errors.
void remove_if_exists(const std::filesystem::path& path);

/// Returns the whole file. \throws MissingInput if the file cannot be opened; IoError if reading
/// fails half-way.
std::string read_file(const std::filesystem::path& path);

/// Size and hash of a file's content.
struct FileDigest {
  std::uint64_t bytes = 0;
  Digest digest;  ///< hash_bytes of the whole file
  bool operator==(const FileDigest&) const = default;
};

/// Computes size and hash of a file, which it reads in pieces. \throws MissingInput, IoError like
/// read_file.
FileDigest hash_file(const std::filesystem::path& path);
/// Whether the file at `path` has this size and hash. Returns false if the file cannot be read.
bool has_content(const std::filesystem::path& path, const FileDigest& content);

/// After this call, each new MappedFile maps its file into memory instead of copying it. Installs a
/// SIGBUS handler for the whole process, which applies OnTruncation if a mapped file is truncated.
/// If the process already has a SIGBUS handler, keeps that handler instead. Call this function at
/// program start.
void watch_mapped_files();

/// What to do when this program reads a mapped file that another program has truncated.
enum class OnTruncation {
  kEnd,  ///< the process ends with exit code 74 and a message that names the file
  kFill  ///< the missing pages read as zeros, and `was_truncated` returns true
};

/// Read-only view of a file's bytes, valid while the object or a copy of it lives. After a call of
/// watch_mapped_files() files are memory-mapped: the kernel can drop and reload their pages, so
/// large inputs do not count as memory of this process. Without that call, the bytes are copied,
/// because without the SIGBUS handler a read from a truncated mapped file would kill the process.
class MappedFile {
 public:
  MappedFile() = default;
  /// \throws MissingInput if the file cannot be opened or is not a regular file; IoError on a read
  /// error, or if the file is truncated while it is copied.
  explicit MappedFile(const std::filesystem::path& path,
                      OnTruncation on_truncation = OnTruncation::kEnd);
  /// Makes a MappedFile from a text in memory, for code that expects a file.
  static MappedFile from_text(std::string text);
  std::string_view bytes() const;
  /// With OnTruncation::kFill, returns whether the file became shorter while it was mapped; in this
  /// case the missing bytes read as zeros. Without kFill, always returns false.
  bool was_truncated() const;

 private:
  struct Mapping;
  /// the file's bytes; null if the file is empty or from_text made this object
  std::shared_ptr<const Mapping> mapping_;
  std::shared_ptr<const std::string> text_;  ///< the text; null unless from_text made this object
};

/// Writes a file atomically. Either `path` is the complete new file afterwards, or the function
/// throws and the old file at `path` (if any) is unchanged. Steps: write a temporary file in the
/// same folder (locked until it is renamed, see remove_temporary_files), fsync, close with error
/// check, rename, fsync the folder. The file is the concatenation of `pieces`. All output files
/// except the log are written this way.
/// \throws CannotCreate, IoError, after removing the temporary file.
void write_file(const std::filesystem::path& path, const std::vector<std::string_view>& pieces);
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file to write.
struct FileToWrite {
  std::filesystem::path path;
  std::vector<std::string_view> pieces;  ///< the concatenated pieces are the file's content
};
/// Like `write_file` for each file, but faster: all files are written before the first is synced
/// and renamed, and each folder is synced once. If an exception is thrown, some of the files may be
/// complete.
/// \throws CannotCreate, IoError, after removing the remaining temporary files.
void write_files(std::span<const FileToWrite> files);

/// Removes the temporary files that killed runs left in this folder, but not in its subfolders.
/// Keeps temporary files that a process on this or another machine is still writing. Does nothing
/// if the folder does not exist.
/// \return number of files removed. \throws IoError if the folder cannot be read.
std::size_t remove_temporary_files(const std::filesystem::path& folder);

/// Creates a folder and its parents. Does nothing for the empty path. \throws CannotCreate.
void make_directories(const std::filesystem::path& path);

}  // namespace crowdface
