// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// What bytes that are no UTF-8 may stand for: the text in UTF-8, if they are GBK (GB 18030), Shift-JIS or Latin-1
/// (Windows-1252). Nothing for UTF-8.
std::vector<std::string> legacy_readings(std::string_view bytes);

}  // namespace crowdface
