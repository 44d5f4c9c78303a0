// SPDX-License-Identifier: Apache-2.0
// Functions that write files; declared in file.h and text_pieces.h.
#include <atomic>
#include <list>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryStart = ".crowdface-", kTemporaryEnd = ".tmp";

/// A name that is unique in this process. The name is short, so that it is valid in every folder in
/// which the final name is valid.
std::string temporary_name() {
  static std::atomic<unsigned> serial{0};
  return concat(kTemporaryStart, ::getpid(), '-', serial++, kTemporaryEnd);
}

bool is_temporary(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with(kTemporaryStart) && name.ends_with(kTemporaryEnd);
}

enum class Claim { kOurs, kTaken, kImpossible };

/// Locks an open file until it is closed, against other processes and machines. Returns kImpossible
/// if the file system does not support locks.
Claim claim(int fd) {
  if (::flock(fd, LOCK_EX | LOCK_NB) == 0) return Claim::kOurs;
  return errno == EWOULDBLOCK || errno == EINTR ? Claim::kTaken : Claim::kImpossible;
}

/// A temporary file beside its target. The file stays locked until it is renamed, so that
/// remove_temporary_files, on any machine, can distinguish it from a file that a killed run left
/// behind.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    struct stat status {};
    if (::lstat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
        !S_ISLNK(status.st_mode)) {
      throw CannotCreate(concat(target.string(), ": expected a regular file, or none yet"));
    }
    constexpr int kTries = 1000;
    for (int i = 0; i < kTries; ++i) {
      path_ = target;
      path_.replace_filename(temporary_name());
      file_ = FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
      if (!file_.valid() && errno == EEXIST) continue;  // made by a killed run or another machine
      if (!file_.valid()) throw_with_errno<CannotCreate>(target, "cannot be created");
      if (lock_unless_claimed_for_removal()) return;
    }
    throw CannotCreate(
        concat(target.string(), ": cannot be created: every temporary file name is taken"));
  }
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Writes the bytes. After every 8 MiB, tells the system to start writing them to disk, so that
  /// `finish` has less to wait for.
  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const std::string_view some = bytes.substr(0, kWritebackSize);
      if (!write_all(file_.get(), some)) fail("writing");
      written_ += some.size();
      bytes.remove_prefix(some.size());
      if (written_ - bytes_in_writeback_ >= kWritebackSize) start_writing_back();
    }
  }

  /// Starts writing to disk without waiting; `finish` reports errors.
  void start_writing_back() {
    ::sync_file_range(file_.get(), static_cast<off_t>(bytes_in_writeback_), 0,
                      SYNC_FILE_RANGE_WRITE);
    bytes_in_writeback_ = written_;
  }

  /// Syncs the file to disk, then closes the file. A duplicate of the descriptor (`lock_`) keeps
  /// the file locked.
  void finish() {
    if (!sync_to_disk(file_.get())) fail("writing to disk");
    // Large new files should not displace other data from the page cache.
    if (written_ >= kWritebackSize) ::posix_fadvise(file_.get(), 0, 0, POSIX_FADV_DONTNEED);
    lock_ = FileDescriptor(::dup(file_.get()));  // keeps the lock after the file is closed
    if (!file_.close()) fail("closing");
  }

  /// Renames the finished file to its target.
  void rename_to_target() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail("renaming into place");
    path_.clear();
  }

 private:
  /// Locks the file. Returns false if remove_temporary_files has locked or removed it already.
  bool lock_unless_claimed_for_removal() const {
    if (claim(file_.get()) == Claim::kTaken) return false;
    struct stat status {};
    if (::fstat(file_.get(), &status) == 0) return status.st_nlink > 0;
    const std::string why = errno_message();
    ::unlink(path_.c_str());
    throw IoError(concat(target_.string(), ": its file status cannot be read: ", why));
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw_with_errno<IoError>(target_, concat(what, " failed"));
  }

  static constexpr std::size_t kWritebackSize = std::size_t{8} << 20U;

  const fs::path& target_;
  fs::path path_;
  FileDescriptor file_{-1}, lock_{-1};
  std::size_t written_ = 0;
  /// number of bytes, from the start of the file, whose writing to disk has been started
  std::size_t bytes_in_writeback_ = 0;
};

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Syncs a folder to disk. After a rename, this is needed so that the new name survives a power
/// cut.
void sync_directory(const fs::path& directory) {
  const FileDescriptor descriptor(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Accept this error: a folder that is writable but not readable cannot be synced.
  if (!descriptor.valid() && errno == EACCES) return;
  if (!descriptor.valid() || !sync_to_disk(descriptor.get())) {
    throw_with_errno<IoError>(directory, "the folder cannot be written to disk");
  }
}

}  // namespace

void write_files(std::span<const FileToWrite> files) {
  std::list<TemporaryFile> written;
  std::set<fs::path> folders;
  for (const FileToWrite& file : files) {
    TemporaryFile& temporary = written.emplace_back(file.path);
    for (const std::string_view piece : file.pieces) temporary.write(piece);
    temporary.start_writing_back();
    folders.insert(folder_of(file.path));
  }
  for (TemporaryFile& temporary : written) temporary.finish();
  for (TemporaryFile& temporary : written) temporary.rename_to_target();
  for (const fs::path& folder : folders) sync_directory(folder);
}

void write_file(const fs::path& path, const std::vector<std::string_view>& pieces) {
  const FileToWrite file{path, pieces};
  write_files({&file, 1});
}

FileDigest write_file(const fs::path& path, const TextPieces& text) {
  constexpr std::size_t kAtOnce = 1U << 20U;
  TemporaryFile file(path);
  std::string pending;
  const FileDigest content = digest_of([&](const TextSink& take) {
    text([&](std::string_view piece) {
      take(piece);
      pending += piece;
      if (pending.size() < kAtOnce) return;
      file.write(pending);
      pending.clear();
    });
  });
  file.write(pending);
  file.finish();
  file.rename_to_target();
  sync_directory(folder_of(path));
  return content;
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file(path, std::vector<std::string_view>{bytes});
}

std::size_t remove_temporary_files(const fs::path& folder) {
  std::size_t removed = 0;
  for (const fs::path& path : list_folder(folder)) {
    if (!is_temporary(path)) continue;
    const FileDescriptor file(::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file.valid() || claim(file.get()) != Claim::kOurs) continue;
    if (::unlink(path.c_str()) == 0) ++removed;
  }
  return removed;
}

void make_directories(const fs::path& path) {
  if (path.empty()) return;
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error)) {
    throw CannotCreate(concat(path.string(), ": folder cannot be created: ",
                              error ? error.message() : "a file has the same name"));
  }
}

}  // namespace crowdface
