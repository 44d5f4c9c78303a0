// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/editor_lock.h"

#include <cerrno>

#include <fcntl.h>

#include "crowdface/core/descriptor.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const fs::path& address) {
  std::string where = "it has not said yet at which address";
  try {
    where = read_file(address);
  } catch (const Error&) {  // it is another user's, or has just begun
  }
  throw UsageError(concat(folder.parent_path().string(), ": is edited already: ", where));
}

}  // namespace

EditorLock::EditorLock(const fs::path& folder) : address_(folder / ".address") {
  lock_ = std::make_unique<FileLock>(folder / ".editor.lock", LockKind::kExclusive,
                                     [&] { refuse(folder, address_); });
}

EditorLock::~EditorLock() {
  remove_if_there(address_);
}

void EditorLock::tell(const std::string& address) {
  remove_if_there(address_);
  constexpr mode_t kOwnerOnly = 0600;
  Descriptor file(
      ::open(address_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerOnly));
  if (!file.valid() || !write_all(file.get(), address) || !file.close()) {
    throw CannotCreate(concat(address_.string(), ": cannot be written: ", reason()));
  }
}

}  // namespace crowdface
