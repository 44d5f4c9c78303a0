// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/file_lock.h"

#include <chrono>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "crowdface/core/descriptor.h"
#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

Descriptor open_lock_file(const fs::path& path) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!file.valid()) {
    throw CannotCreate(concat(path.string(), ": lock file cannot be created: ", reason()));
  }
  return file;
}

/// Whether the path still names this file: who held it last may have removed it.
bool names(const fs::path& path, const Descriptor& file) {
  struct stat by_name {
  }, by_descriptor{};
  return ::stat(path.c_str(), &by_name) == 0 && ::fstat(file.get(), &by_descriptor) == 0 &&
         by_name.st_ino == by_descriptor.st_ino && by_name.st_dev == by_descriptor.st_dev;
}

}  // namespace

FileLock::FileLock(const fs::path& path, LockKind kind, const std::function<void()>& waiting)
    : path_(path) {
  const int operation = (kind == LockKind::kExclusive ? LOCK_EX : LOCK_SH) | LOCK_NB;
  bool told = false;
  Descriptor file = open_lock_file(path);
  for (;;) {
    if (::flock(file.get(), operation) == 0) {
      if (names(path, file)) break;
      file = open_lock_file(path);
      continue;
    }
    if (errno != EWOULDBLOCK && errno != EINTR) {
      throw IoError(concat(path.string(), ": cannot be locked: ", reason()));
    }
    if (!told && waiting) waiting();
    told = true;
    throw_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  file_ = std::make_unique<Descriptor>(std::move(file));
}

FileLock::~FileLock() {
  // Only who has it alone removes it; others find out by `names` that it is gone.
  if (::flock(file_->get(), LOCK_EX | LOCK_NB) == 0) ::unlink(path_.c_str());
}

}  // namespace crowdface
