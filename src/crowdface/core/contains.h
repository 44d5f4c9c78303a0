// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <ranges>

namespace crowdface {

/// Whether a range contains a value.
template <std::ranges::input_range Range, class Value>
bool contains(const Range& range, const Value& value) {
  return std::ranges::find(range, value) != std::ranges::end(range);
}

}  // namespace crowdface
