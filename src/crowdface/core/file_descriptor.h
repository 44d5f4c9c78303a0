// SPDX-License-Identifier: Apache-2.0
// POSIX file descriptors, for code that makes system calls.
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/text.h"

namespace crowdface {

/// The message of `errno`: why the last system call failed.
inline std::string errno_message() {
  return std::generic_category().message(errno);
}

/// \throws Failure with the message "FILE: WHAT: REASON", where REASON explains `errno`.
template <class Failure>
[[noreturn]] void throw_with_errno(const std::filesystem::path& file, std::string_view what) {
  throw Failure(concat(file.string(), ": ", what, ": ", errno_message()));
}

/// A file descriptor that is closed on destruction.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }

  /// Closes the descriptor. On some file systems, only the result of this function shows that an
  /// earlier write failed.
  /// \return whether closing succeeded.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;  ///< negative: no file is open
};

/// Whether an error number means a failure of the machine (disk, memory, too many open files) and
/// not a fault of the file.
bool is_system_error(int error);
/// \throws IoError on a system error (disk, memory, too many open files) that occurred while the
/// status of `path` was read.
void throw_if_system_error(const std::filesystem::path& path, const std::error_code& error);

/// Whether `path`, with links followed, still names the open file `file`. False after the file was
/// removed, renamed or replaced. \throws IoError on a system error (disk, memory, too many open
/// files).
bool path_leads_to(const std::filesystem::path& path, const FileDescriptor& file);

/// A file opened for reading, with its size in bytes.
struct OpenedFile {
  FileDescriptor descriptor;
  std::size_t size;  ///< size of the file in bytes
};
/// Opens a regular file.
/// \throws MissingInput if `path` is not a regular file or cannot be opened; IoError if the cause
/// is the machine (disk error, out of memory, too many open files).
OpenedFile open_for_reading(const std::filesystem::path& path);
/// Reads `size` bytes, or all bytes up to the end of the file if there are fewer.
/// \param path  named in the error message.
/// \return      number of bytes read. \throws IoError.
std::size_t read_up_to(const FileDescriptor& file, char* to, std::size_t size,
                       const std::filesystem::path& path);

/// Writes all bytes, with as many system calls as needed. \return whether it succeeded.
inline bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Flushes the file to disk (fsync).
/// \return whether the flush succeeded; true for files that are not on a disk, such as pipes.
inline bool sync_to_disk(int fd) {
  while (::fsync(fd) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOTSUP;
  }
  return true;
}

}  // namespace crowdface
