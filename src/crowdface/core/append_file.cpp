// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/append_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include "crowdface/core/error.h"

namespace crowdface {

AppendFile::AppendFile(const std::filesystem::path& path)
    : path_(path),
      file_(::open(path.c_str(),
                   O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666)) {
  if (!file_.valid()) throw_with_errno<CannotCreate>(path, "cannot be opened to append");
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0)
    throw_with_errno<IoError>(path, "its file status cannot be read");
  if (!S_ISREG(status.st_mode)) {
    throw CannotCreate(concat(path.string(), ": expected a regular file, or none yet"));
  }
}

void AppendFile::append(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  if (!write_all(file_.get(), bytes) || !sync_to_disk(file_.get())) {
    throw_with_errno<IoError>(path_, "appending failed");
  }
}

}  // namespace crowdface
