// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/file.h"

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

std::string reason() {
  return std::generic_category().message(errno);
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }
  /// Closes and tells whether that worked: on some file systems a write fails only here.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

struct OpenedFile {
  Descriptor descriptor;
  std::size_t size;
};

OpenedFile open_for_reading(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw MissingInput(concat(path.string(), ": cannot be opened: ", reason()));
  struct stat status {};
  if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(fd);
    throw MissingInput(concat(path.string(), ": expected a regular file"));
  }
  return {Descriptor(fd), static_cast<std::size_t>(status.st_size)};
}

bool write_all(int fd, std::string_view bytes) {
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

/// The new name must outlive a power cut, and a rename lives in the folder.
void sync_directory(const fs::path& directory) {
  const Descriptor descriptor(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!descriptor.valid()) return;
  if (::fsync(descriptor.get()) != 0 && errno != EINVAL) {
    throw IoError(concat(directory.string(), ": cannot be synchronised: ", reason()));
  }
}

}  // namespace

std::string read_file(const fs::path& path) {
  const OpenedFile file = open_for_reading(path);
  std::string bytes(file.size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(file.descriptor.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw IoError(concat(path.string(), ": reading failed: ", reason()));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
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

void write_file(const fs::path& path, const std::vector<std::string_view>& pieces) {
  static std::atomic<unsigned> serial{0};
  fs::path temporary = path;
  temporary.replace_filename(
      concat(".", path.filename().string(), ".", ::getpid(), ".", serial++, ".tmp"));
  Descriptor descriptor(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!descriptor.valid()) {
    throw CannotCreate(concat(path.string(), ": cannot be created: ", reason()));
  }
  const auto fail = [&](std::string_view what) {
    const std::string why = reason();
    ::unlink(temporary.c_str());
    throw IoError(concat(path.string(), ": ", what, " failed: ", why));
  };
  for (const std::string_view piece : pieces) {
    if (!write_all(descriptor.get(), piece)) fail("writing");
  }
  if (::fsync(descriptor.get()) != 0 && errno != EINVAL) fail("writing to disk");
  if (!descriptor.close()) fail("closing");
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail("renaming into place");
  sync_directory(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file(path, std::vector<std::string_view>{bytes});
}

void make_directories(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error)) {
    throw CannotCreate(concat(path.string(), ": folder cannot be created: ",
                              error ? error.message() : "something else has that name"));
  }
}

}  // namespace crowdface
