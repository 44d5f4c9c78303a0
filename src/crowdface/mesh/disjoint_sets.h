// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace crowdface {

/// Disjoint sets of numbered items (union-find). At first, every item is in a separate set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// The smallest item in the set of `item`.
  std::uint32_t root(std::uint32_t item) {
    while (parent_[item] != item) {
      item = parent_[item] = parent_[parent_[item]];  // path halving
    }
    return item;
  }
  /// Unites the sets of items a and b.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Makes `item` a set of its own again. Callers must release all items of a set or none;
  /// otherwise the remaining items may keep a wrong root.
  void release(std::uint32_t item) { parent_[item] = item; }

 private:
  /// for each item, another item of its set, nearer to the set's root; a root is its own parent
  std::vector<std::uint32_t> parent_;
};

}  // namespace crowdface
