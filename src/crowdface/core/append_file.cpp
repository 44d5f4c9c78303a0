// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/append_file.h"

#include <fcntl.h>

#include "crowdface/core/descriptor.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {

AppendFile::AppendFile(const std::filesystem::path& path)
    : path_(path),
      file_(std::make_unique<Descriptor>(
          ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666))) {
  if (!file_->valid()) {
    throw CannotCreate(concat(path.string(), ": cannot be opened to append: ", reason()));
  }
}

AppendFile::~AppendFile() = default;

void AppendFile::append(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  const int fd = file_->get();
  if (!write_all(fd, bytes) || !sync(fd)) {
    throw IoError(concat(path_.string(), ": appending failed: ", reason()));
  }
}

}  // namespace crowdface
