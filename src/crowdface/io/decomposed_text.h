// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace crowdface {

/// Converts composed letters, such as é, to a base letter and combining marks (Unicode's normal
/// form D). Knows the composed letters of Latin, Greek, Cyrillic, Japanese and Korean text; other
/// characters stay. macOS stores file names in this form; other systems use composed letters.
/// \param text  UTF-8; invalid bytes stay.
std::string decomposed(std::string_view text);

}  // namespace crowdface
