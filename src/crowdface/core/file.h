// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The whole file. \throws MissingInput if it cannot be opened, IoError if reading fails half-way.
std::string read_file(const std::filesystem::path& path);

/// A file's bytes mapped read-only for as long as the object lives; the pages belong to the system,
/// so that large inputs cost no memory of ours.
class MappedFile {
 public:
  MappedFile() = default;
  /// \throws MissingInput if the file cannot be opened or is no regular file.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  std::string_view bytes() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Writes a file so that it is either whole under its final name or not there at all: temporary
/// file in the same folder, fsync, rename, fsync of the folder. The pieces are written one after
/// the other. \throws CannotCreate, IoError; the temporary file is removed.
void write_file(const std::filesystem::path& path, const std::vector<std::string_view>& pieces);
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Creates a folder and its parents. \throws CannotCreate.
void make_directories(const std::filesystem::path& path);

}  // namespace crowdface
