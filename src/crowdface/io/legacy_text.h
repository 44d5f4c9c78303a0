// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Decodes a text of unknown encoding as GBK (GB 18030), as Shift-JIS and as Latin-1
/// (Windows-1252). Returns each valid result, converted to UTF-8. Returns nothing if the text
/// already is UTF-8 or is longer than 4096 bytes.
std::vector<std::string> legacy_decodings(std::string_view bytes);

/// Removes the byte order mark of a text in UTF-8, and converts a text in UTF-16 that starts with a
/// byte order mark to UTF-8. Returns an empty text if the UTF-16 is invalid.
std::string without_byte_order_mark(std::string_view bytes);

}  // namespace crowdface
