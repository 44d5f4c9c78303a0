// SPDX-License-Identifier: Apache-2.0
// For the .cpp files of core that read files.
#pragma once

#include <cstddef>
#include <filesystem>

#include "crowdface/core/descriptor.h"

namespace crowdface {

struct OpenedFile {
  Descriptor descriptor;
  std::size_t size;
};

/// \throws MissingInput if there is no such regular file; IoError if the machine is to blame.
OpenedFile open_for_reading(const std::filesystem::path& path);

}  // namespace crowdface
