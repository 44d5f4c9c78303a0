// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace crowdface {

/// A share of the memory that all images together may take (input_limits().image_bytes): it is given
/// back when nobody holds it any more.
using ImageMemory = std::shared_ptr<const void>;

/// Any thread may ask. \throws InvalidInput, naming the file, if all images would take too much.
ImageMemory take_image_memory(const std::filesystem::path& file, std::uint64_t bytes);

/// What of it nobody holds at present.
std::uint64_t free_image_memory();

}  // namespace crowdface
