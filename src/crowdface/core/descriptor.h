// SPDX-License-Identifier: Apache-2.0
// For what speaks to the operating system.
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

/// Why the last system call failed.
inline std::string reason() {
  return std::generic_category().message(errno);
}

/// \throws Failure "FILE: WHAT: why the last system call failed".
template <class Failure>
[[noreturn]] void throw_with_reason(const std::filesystem::path& file, std::string_view what) {
  throw Failure(concat(file.string(), ": ", what, ": ", reason()));
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }

  /// Closes and tells whether that worked: on some file systems a write fails only here.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// Whether the path, links followed, leads to the very file that is open: that may have been removed or renamed.
inline bool still_names(const std::filesystem::path& path, const Descriptor& file) {
  struct stat by_name {
  }, by_descriptor{};
  return ::stat(path.c_str(), &by_name) == 0 && ::fstat(file.get(), &by_descriptor) == 0 &&
         by_name.st_ino == by_descriptor.st_ino && by_name.st_dev == by_descriptor.st_dev;
}

/// A file that can be read, and how large it is.
struct OpenedFile {
  Descriptor descriptor;
  std::size_t size;
};
/// \throws MissingInput if there is no such regular file; IoError if the machine is to blame.
OpenedFile open_for_reading(const std::filesystem::path& path);
/// Reads `size` bytes, or as many as the file has. \return how many. \param path  for the message. \throws IoError
std::size_t read_up_to(const Descriptor& file, char* to, std::size_t size,
                       const std::filesystem::path& path);

/// Writes all of it, however many calls that takes. \return whether it worked.
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

/// Has the file's bytes on the disk. \return whether it worked; what has no disk (a pipe) is fine.
inline bool sync(int fd) {
  while (::fsync(fd) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOTSUP;
  }
  return true;
}

}  // namespace crowdface
