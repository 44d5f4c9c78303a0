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

/// Converts the content of a text file to UTF-8 without a byte-order mark, and turns single CR line
/// ends into LF. Reads UTF-16 only after a byte-order mark. Returns an empty text for invalid
/// UTF-16.
std::string plain_text(std::string_view bytes);

/// Like plain_text, but also converts text that is not UTF-8. If most bytes beyond ASCII are next
/// to each other, as in Chinese and Japanese, converts from GBK (GB 18030) or Shift-JIS; otherwise
/// from Latin-1 (Windows-1252).
std::string decoded_text(std::string_view bytes);

}  // namespace crowdface
