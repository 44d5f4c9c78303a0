// SPDX-License-Identifier: Apache-2.0
// Functions that test whether files exist and read files; declared in file.h, text_pieces.h and
// file_descriptor.h.
#include <algorithm>
#include <array>

#include <fcntl.h>
#include <sys/stat.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/text.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Calls POSIX read() once and returns the number of bytes read; 0 at the end of the file.
std::size_t read_some(const FileDescriptor& descriptor, char* to, std::size_t size,
                      const fs::path& path) {
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw_with_errno<IoError>(path, "reading failed");
  }
}

fs::file_status status_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  throw_if_system_error(path, error);
  return fs::status_known(status) ? status : fs::file_status(fs::file_type::not_found);
}

}  // namespace

bool is_system_error(int error) {
  constexpr std::array kFaults = {EIO, EMFILE, ENFILE, ENOMEM, ENOSPC, ESTALE, ETIMEDOUT};
  return std::ranges::find(kFaults, error) != kFaults.end();
}

void throw_if_system_error(const fs::path& path, const std::error_code& error) {
  if (!is_system_error(error.value())) return;
  throw IoError(concat(path.string(), ": its file status cannot be read: ", error.message()));
}

bool path_leads_to(const fs::path& path, const FileDescriptor& file) {
  struct stat by_name {
  }, by_descriptor{};
  const auto look = [&](int failed) {
    if (failed != 0) throw_if_system_error(path, {errno, std::generic_category()});
    return failed == 0;
  };
  return look(::stat(path.c_str(), &by_name)) && look(::fstat(file.get(), &by_descriptor)) &&
         by_name.st_ino == by_descriptor.st_ino && by_name.st_dev == by_descriptor.st_dev;
}

bool path_exists(const fs::path& path) {
  return fs::exists(status_of(path));
}

bool is_folder(const fs::path& path) {
  return fs::is_directory(status_of(path));
}

bool is_file(const fs::path& path) {
  return fs::is_regular_file(status_of(path));
}

void remove_if_exists(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

OpenedFile open_for_reading(const fs::path& path) {
  int fd = -1;
  do {  // O_NONBLOCK: do not wait for the writer of a pipe; the check below rejects pipes
    fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  } while (fd < 0 && errno == EINTR);
  if (fd < 0) {
    if (is_system_error(errno)) throw_with_errno<IoError>(path, "cannot be opened");
    throw_with_errno<MissingInput>(path, "cannot be opened");
  }
  struct stat status {};
  FileDescriptor descriptor(fd);
  if (::fstat(fd, &status) != 0) throw_with_errno<IoError>(path, "its file status cannot be read");
  if (!S_ISREG(status.st_mode)) {
    throw MissingInput(concat(path.string(), ": expected a regular file"));
  }
  return {std::move(descriptor), static_cast<std::size_t>(status.st_size)};
}

std::size_t read_up_to(const FileDescriptor& file, char* to, std::size_t size,
                       const fs::path& path) {
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

void read_pieces(const fs::path& path, const TextSink& take) {
  constexpr std::size_t kPiece = 1U << 20U;
  const OpenedFile file = open_for_reading(path);
  std::string piece(std::min(kPiece, file.size + 1), '\0');
  while (const std::size_t got = read_some(file.descriptor, piece.data(), piece.size(), path)) {
    take({piece.data(), got});
  }
}

FileDigest hash_file(const fs::path& path) {
  return digest_of([&](const TextSink& take) { read_pieces(path, take); });
}

bool has_content(const fs::path& path, const FileDigest& content) {
  std::error_code error;
  if (fs::file_size(path, error) != content.bytes || error) return false;
  try {
    return hash_file(path) == content;
  } catch (const RecoverableError&) {
    return false;
  }
}

}  // namespace crowdface
