// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Decodes bytes that are not UTF-8 as GBK (GB 18030), Shift-JIS and Latin-1 (Windows-1252), and
/// returns each valid result as UTF-8. Empty if the bytes are UTF-8.
std::vector<std::string> legacy_decodings(std::string_view bytes);

}  // namespace crowdface
