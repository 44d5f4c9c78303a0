// SPDX-License-Identifier: Apache-2.0
// File tests and reading, declared in file.h, text_pieces.h and descriptor.h.
#include <algorithm>

#include <fcntl.h>
#include <sys/stat.h>

#include "crowdface/core/descriptor.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Reads once. \return number of bytes; 0 at the end of the file.
std::size_t read_some(const Descriptor& descriptor, char* to, std::size_t size,
                      const fs::path& path) {
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw_with_reason<IoError>(path, "reading failed");
  }
}

}  // namespace

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

void remove_if_there(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

OpenedFile open_for_reading(const fs::path& path) {
  int fd = -1;
  do {  // O_NONBLOCK: open() would wait for the writer of a pipe; the check below rejects pipes
    fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  } while (fd < 0 && errno == EINTR);
  if (fd < 0) {
    // These errors are caused by the machine (disk, memory, too many open files), not by the file.
    for (const int failure : {EIO, EMFILE, ENFILE, ENOMEM, ENOSPC, ESTALE}) {
      if (errno == failure) throw_with_reason<IoError>(path, "cannot be opened");
    }
    throw_with_reason<MissingInput>(path, "cannot be opened");
  }
  struct stat status {};
  Descriptor descriptor(fd);
  if (::fstat(fd, &status) != 0) throw_with_reason<IoError>(path, "cannot be looked at");
  if (!S_ISREG(status.st_mode)) {
    throw MissingInput(concat(path.string(), ": expected a regular file"));
  }
  return {std::move(descriptor), static_cast<std::size_t>(status.st_size)};
}

std::size_t read_up_to(const Descriptor& file, char* to, std::size_t size, const fs::path& path) {
  std::size_t done = 0;
  while (done < size) {
    const std::size_t got = read_some(file, to + done, size - done, path);
    if (got == 0) break;
    done += got;
  }
  return done;
}

std::string read_file(const fs::path& path) {
  const OpenedFile file = open_for_reading(path);
  std::string bytes(file.size, '\0');
  bytes.resize(read_up_to(file.descriptor, bytes.data(), bytes.size(), path));
  return bytes;
}

void read_pieces(const fs::path& path, const TakePiece& take) {
  constexpr std::size_t kPiece = 1U << 20U;
  const OpenedFile file = open_for_reading(path);
  std::string piece(std::min(kPiece, file.size + 1), '\0');
  while (const std::size_t got = read_some(file.descriptor, piece.data(), piece.size(), path)) {
    take({piece.data(), got});
  }
}

FileDigest hash_file(const fs::path& path) {
  return digest_of([&](const TakePiece& take) { read_pieces(path, take); });
}

bool holds(const fs::path& path, const FileDigest& content) {
  std::error_code error;
  if (fs::file_size(path, error) != content.bytes || error) return false;
  try {
    return hash_file(path) == content;
  } catch (const RecoverableError&) {
    return false;
  }
}

}  // namespace crowdface
