// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/file_lock.h"

#include <chrono>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

FileDescriptor open_lock_file(const fs::path& path) {
  FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!file.valid()) throw_with_errno<CannotCreate>(path, "lock file cannot be created");
  return file;
}

}  // namespace

FileLock::FileLock(const fs::path& path, LockKind kind, const std::function<void()>& on_waiting)
    : path_(path), file_(open_lock_file(path)) {
  const int operation = (kind == LockKind::kExclusive ? LOCK_EX : LOCK_SH) | LOCK_NB;
  bool told = false;
  for (;;) {
    throw_if_interrupted();
    if (::flock(file_.get(), operation) == 0) {
      // The previous holder of the lock may have removed the file that this thread waited for. If
      // so, open the file at the path again.
      if (path_leads_to(path, file_)) return;
      file_ = open_lock_file(path);
      continue;
    }
    if (errno != EWOULDBLOCK && errno != EINTR) {
      throw_with_errno<IoError>(path, "cannot be locked");
    }
    if (!told && on_waiting) on_waiting();
    told = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

FileLock::~FileLock() {
  // Only a process that holds the lock exclusively removes the file. Waiting processes detect the
  // removal with `path_leads_to`.
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(path_.c_str());
}

}  // namespace crowdface
