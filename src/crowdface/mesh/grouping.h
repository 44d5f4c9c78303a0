// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace crowdface {

/// Which of some numbered things belong together. At first each is a group by itself.
class Grouping {
 public:
  explicit Grouping(std::size_t things) : parent_(things) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// The smallest number in a thing's group.
  std::uint32_t root(std::uint32_t thing) {
    while (parent_[thing] != thing) {
      thing = parent_[thing] =
          parent_[parent_[thing]];  // half as long a way for whoever comes next
    }
    return thing;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Undoes what was joined: for all of a group at once.
  void release(std::uint32_t thing) { parent_[thing] = thing; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace crowdface
