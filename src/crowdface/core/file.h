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

/// Whether something, a folder, a regular file bears this name, links followed; no where that cannot be told.
bool is_there(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
bool is_file(const std::filesystem::path& path);
/// What cannot be removed stays.
void remove_if_there(const std::filesystem::path& path);

/// The whole file. \throws MissingInput if it cannot be opened, IoError if reading fails half-way.
std::string read_file(const std::filesystem::path& path);

/// What a file holds, without its bytes.
struct FileDigest {
  std::uint64_t bytes = 0;
  Digest digest;  ///< hash_bytes of the whole
  bool operator==(const FileDigest&) const = default;
};

/// Reads a file piece by piece. \throws MissingInput, IoError like read_file.
FileDigest hash_file(const std::filesystem::path& path);
/// Whether the file holds just that; a file that cannot be read does not.
bool holds(const std::filesystem::path& path, const FileDigest& content);

/// From now on a MappedFile maps its file and no longer copies it, and a handler of SIGBUS sees to files that
/// somebody cuts while they are mapped. For programs, at their start: the handler belongs to the whole process.
void watch_mapped_files();

/// What the handler does when somebody cuts a mapped file.
enum class WhenCut {
  kEnd,  ///< it ends the process with code 74 and a message that names the file
  kFill  ///< what is gone reads as zeros, and `was_cut` tells
};

/// A file's bytes, read-only, for as long as the object or a copy of it lives. After watch_mapped_files() the pages
/// belong to the system, so that large inputs cost no memory of ours. Before, they are a copy, because nobody
/// could catch the signal that a cut file raises.
class MappedFile {
 public:
  MappedFile() = default;
  /// \throws MissingInput if the file cannot be opened or is no regular file; IoError, also if somebody cuts the
  ///         file while it is copied.
  explicit MappedFile(const std::filesystem::path& path, WhenCut when_cut = WhenCut::kEnd);
  /// Puts bytes into a file without a name, which goes with the process however that ends, and maps it: from
  /// then on they lie on the disk, and in memory as far as the system has room.
  /// \param folder  where; it is made if it is not there. \throws CannotCreate, IoError.
  static MappedFile of_scratch(std::string_view bytes, const std::filesystem::path& folder);
  /// A text in memory that takes the place of a file.
  static MappedFile of_text(std::string text);
  std::string_view bytes() const;
  /// Whether the file has become shorter: then some of the bytes may be zeros that it never held.
  bool was_cut() const;

 private:
  struct Mapping;
  std::shared_ptr<const Mapping> mapping_;   ///< none of an empty file
  std::shared_ptr<const std::string> text_;  ///< instead of a mapping
};

/// Writes a file so that it is either whole under its final name or not there at all: temporary
/// file in the same folder (locked while it is written, see remove_leftovers), fsync, checked close,
/// rename, fsync of the folder. The pieces are written one after the other. Every file that
/// crowdface leaves behind, but for the log, is written here.
/// \throws CannotCreate, IoError; the temporary file is removed.
void write_file(const std::filesystem::path& path, const std::vector<std::string_view>& pieces);
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file that is to be written, one piece after the other.
struct FileToWrite {
  std::filesystem::path path;
  std::vector<std::string_view> pieces;
};
/// Writes each as `write_file` does, but waits for the disk once and not file by file: all are written before the
/// first is synced and named, and each folder is synced once. Some of them may be there if this throws.
/// \throws CannotCreate, IoError; their temporary files are removed.
void write_files(std::span<const FileToWrite> files);

/// Removes the temporary files that killed runs left in this folder (not in those below it), and
/// none that is still being written, here or on another machine. A folder that is not there has
/// none. \return how many. \throws IoError if the folder cannot be read.
std::size_t remove_leftovers(const std::filesystem::path& folder);

/// Creates a folder and its parents; the empty path is the working directory. \throws CannotCreate.
void make_directories(const std::filesystem::path& path);

}  // namespace crowdface
