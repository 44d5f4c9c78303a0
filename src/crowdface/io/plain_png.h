// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace crowdface {

/// A small PNG that is not packed: its bytes depend on the pixels alone, where encode_png's depend on the
/// libraries that it is built with.
/// \param pixels  red green blue of each, rows from above
/// \throws BrokenPrecondition if they are not width · height, or take more than 65,535 bytes.
std::string plain_png(int width, int height, std::span<const std::uint8_t> pixels);

}  // namespace crowdface
