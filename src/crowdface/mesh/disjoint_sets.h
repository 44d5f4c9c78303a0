// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace crowdface {

/// Disjoint sets of numbered items (union-find). At first each item is its own group.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t things) : parent_(things) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// The smallest item in the group to which `thing` belongs.
  std::uint32_t root(std::uint32_t thing) {
    while (parent_[thing] != thing) {
      thing = parent_[thing] = parent_[parent_[thing]];  // path halving
    }
    return thing;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Makes an item its own group again. Call this for every item of a group; otherwise the
  /// remaining items refer to a wrong root.
  void release(std::uint32_t thing) { parent_[thing] = thing; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace crowdface
