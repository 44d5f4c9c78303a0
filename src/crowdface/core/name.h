// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace crowdface {

inline constexpr std::size_t kLongestName = 64;
inline constexpr std::size_t kLongestId = 2 * kLongestName + 22;  ///< CROWD_FAMILY_NUMBER

/// Whether it is a name that can be a file's on any system: at most `longest` letters (a–z), digits,
/// '_', '-' and '.', not starting with '.', and not empty; nor __proto__, by which a script's objects
/// keep what is none of theirs.
bool is_name(std::string_view text, std::size_t longest = kLongestName);

}  // namespace crowdface
