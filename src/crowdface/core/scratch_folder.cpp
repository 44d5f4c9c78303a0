// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/text.h"

namespace crowdface {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "crowdface-XXXXXX").string();
  if (error) {
    throw CannotCreate(concat("no folder for temporary files: ", error.message(),
                              "; set TMPDIR to a folder that exists"));
  }
  if (::mkdtemp(name.data()) == nullptr) throw_with_errno<CannotCreate>(name, "cannot be created");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace crowdface
