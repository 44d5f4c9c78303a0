// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/file.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/descriptor.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct OpenedFile {
  Descriptor descriptor;
  std::size_t size;
};

OpenedFile open_for_reading(const fs::path& path) {
  int fd = -1;
  do {  // a pipe, which would be waited for, is told below
    fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  } while (fd < 0 && errno == EINTR);
  if (fd < 0) {
    const std::string message = concat(path.string(), ": cannot be opened: ", reason());
    // Not the file's fault, but the machine's: the disk, or too many open files.
    for (const int failure : {EIO, EMFILE, ENFILE, ENOMEM, ENOSPC, ESTALE}) {
      if (errno == failure) throw IoError(message);
    }
    throw MissingInput(message);
  }
  struct stat status {};
  if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(fd);
    throw MissingInput(concat(path.string(), ": expected a regular file"));
  }
  return {Descriptor(fd), static_cast<std::size_t>(status.st_size)};
}

/// \return 0 at the end of the file.
std::size_t read_some(const Descriptor& descriptor, char* to, std::size_t size,
                      const fs::path& path) {
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw IoError(concat(path.string(), ": reading failed: ", reason()));
  }
}

}  // namespace

std::string read_file(const fs::path& path) {
  const OpenedFile file = open_for_reading(path);
  std::string bytes(file.size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::size_t got =
        read_some(file.descriptor, bytes.data() + done, bytes.size() - done, path);
    if (got == 0) break;
    done += got;
  }
  bytes.resize(done);
  return bytes;
}

FileDigest hash_file(const fs::path& path) {
  constexpr std::size_t kPiece = 1U << 20U;
  const OpenedFile file = open_for_reading(path);
  Hasher hasher;
  FileDigest result;
  std::string piece(std::min(kPiece, file.size + 1), '\0');
  while (const std::size_t got = read_some(file.descriptor, piece.data(), piece.size(), path)) {
    hasher.add_raw(std::string_view(piece.data(), got));
    result.bytes += got;
  }
  result.digest = hasher.digest();
  return result;
}

bool holds(const std::filesystem::path& path, const FileDigest& content) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) != content.bytes || error) return false;
  try {
    return hash_file(path) == content;
  } catch (const Error&) {
    return false;
  }
}

MappedFile::MappedFile(const fs::path& path) {
  const OpenedFile file = open_for_reading(path);
  if (file.size == 0) return;
  void* data = ::mmap(nullptr, file.size, PROT_READ, MAP_PRIVATE, file.descriptor.get(), 0);
  if (data == MAP_FAILED)
    throw MissingInput(concat(path.string(), ": cannot be mapped: ", reason()));
  data_ = static_cast<const char*>(data);
  size_ = file.size;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

}  // namespace crowdface
