// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

namespace crowdface {

/// Reads JSON that others may have written. Values deeper than any of ours are left out: the library
/// copies and prints values by recursion, and a hostile line would end on the stack's last page.
/// \return what `is_discarded()` if the text is no JSON, or has an object of more keys than any of ours:
/// the library compares each with all before it.
inline nlohmann::ordered_json parse_shallow_json(std::string_view text) {
  using Value = nlohmann::ordered_json;
  constexpr int kDeepest = 64, kMostKeys = 1024;
  struct TooManyKeys {};
  std::array<int, kDeepest + 1> keys{};  // of the object that is open at each depth
  const auto keep = [&](int depth, Value::parse_event_t event, Value&) {
    if (depth >= kDeepest) return false;
    const auto at = static_cast<std::size_t>(depth);
    if (event == Value::parse_event_t::object_start) keys[at + 1] = 0;
    if (event == Value::parse_event_t::key && ++keys[at] > kMostKeys) throw TooManyKeys();
    return true;
  };
  try {
    return Value::parse(text, keep, false);
  } catch (const TooManyKeys&) {
    return Value(Value::value_t::discarded);
  }
}

}  // namespace crowdface
