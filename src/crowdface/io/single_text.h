// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

/// No single-precision number is longer: "-1.17549435e-38".
inline constexpr std::size_t kLongestSingle = 15;
/// How much room write_single needs: it writes more than it means to keep.
inline constexpr std::size_t kSingleRoom = 24;

/// Writes the shortest text that reads back as the same single-precision number, the very text of
/// std::to_chars, to `out`, where there is room for kSingleRoom characters. \return where it ends.
char* write_single(char* out, double value);

}  // namespace crowdface
