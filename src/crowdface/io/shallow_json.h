// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace crowdface {

/// Reads JSON that others may have written. Values deeper than any of ours are left out: the library
/// copies and prints values by recursion, and a hostile line would end on the stack's last page.
/// \return what `is_discarded()` if the text is no JSON.
inline nlohmann::ordered_json parse_shallow_json(std::string_view text) {
  constexpr int kDeepest = 64;
  using Event = nlohmann::ordered_json::parse_event_t;
  return nlohmann::ordered_json::parse(
      text, [](int depth, Event, nlohmann::ordered_json&) { return depth < kDeepest; }, false);
}

}  // namespace crowdface
