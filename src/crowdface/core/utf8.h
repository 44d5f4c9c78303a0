// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace crowdface {

/// Whether a byte is the second or a later one of a UTF-8 character.
inline bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Bytes of the UTF-8 character that `text`, not empty, starts with; 0 if it is none (RFC 3629: no
/// overlong forms, no surrogates, nothing above U+10FFFF).
std::size_t utf8_length(std::string_view text);

/// Whether all of `text` is UTF-8. (A file's name may hold any bytes.)
bool is_utf8(std::string_view text);

}  // namespace crowdface
