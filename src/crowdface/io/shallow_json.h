// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

namespace crowdface {

/// Parses untrusted JSON. Drops values nested deeper than 64 levels: the library copies and prints
/// values recursively, and hostile input would overflow the stack.
/// \return a value for which `is_discarded()` holds if the text is not JSON, or if an object has
/// more than 1024 keys: the library compares each key with all keys before it.
inline nlohmann::ordered_json parse_shallow_json(std::string_view text) {
  using Value = nlohmann::ordered_json;
  constexpr int kMaxDepth = 64, kMaxKeys = 1024;
  struct TooManyKeys {};
  std::array<int, kMaxDepth + 1> keys{};  // number of keys of the open object at each depth
  const auto keep = [&](int depth, Value::parse_event_t event, Value&) {
    if (depth >= kMaxDepth) return false;
    const auto at = static_cast<std::size_t>(depth);
    if (event == Value::parse_event_t::object_start) keys[at + 1] = 0;
    if (event == Value::parse_event_t::key && ++keys[at] > kMaxKeys) throw TooManyKeys();
    return true;
  };
  try {
    return Value::parse(text, keep, false);
  } catch (const TooManyKeys&) {
    return Value(Value::value_t::discarded);
  }
}

}  // namespace crowdface
