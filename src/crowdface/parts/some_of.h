// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace crowdface {

/// Not more than `most` of some things, evenly chosen, in their order.
template <class T>
std::vector<T> some_of(std::span<const T> all, std::size_t most) {
  const std::size_t count = std::min(all.size(), most);
  std::vector<T> some;
  some.reserve(count);
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

}  // namespace crowdface
