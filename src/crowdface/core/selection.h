// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <vector>

namespace crowdface {

/// At most `max_count` of the items in `all`, evenly spaced, in their original order.
template <class Items>
std::vector<std::ranges::range_value_t<Items>> evenly_spaced_items(const Items& all,
                                                                   std::size_t max_count) {
  const std::size_t count = std::min(all.size(), max_count);
  std::vector<std::ranges::range_value_t<Items>> selected;
  selected.reserve(count);
  for (std::size_t i = 0; i < count; ++i) selected.push_back(all[i * all.size() / count]);
  return selected;
}
/// The value that would be at index `rank` if the values were sorted in ascending order.
/// \param rank  < values.size().
inline double nth_smallest(std::vector<double> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace crowdface
