// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/opened_file.h"

#include <utility>

#include <fcntl.h>
#include <sys/stat.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {

namespace fs = std::filesystem;

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
  Descriptor descriptor(fd);
  if (::fstat(fd, &status) != 0) {
    throw IoError(concat(path.string(), ": cannot be looked at: ", reason()));
  }
  if (!S_ISREG(status.st_mode)) {
    throw MissingInput(concat(path.string(), ": expected a regular file"));
  }
  return {std::move(descriptor), static_cast<std::size_t>(status.st_size)};
}

}  // namespace crowdface
