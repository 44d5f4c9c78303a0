// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace crowdface {

/// Groups of items, stored one group after the other in a single array (compressed rows). Groups
/// are numbered from 0.
template <class T>
struct CompressedRows {
  std::vector<std::uint32_t> offsets = {0};  ///< #groups + 1: where each group begins in `items`
  std::vector<T> items;  ///< group g: the items at offsets[g] … offsets[g + 1] − 1

  std::size_t group_count() const { return offsets.size() - 1; }
  /// The items of one group.
  template <std::integral Number>
  std::span<const T> items_of(Number group) const {
    const T* const first = items.data() + offsets[static_cast<std::size_t>(group)];
    return {first, items.data() + offsets[static_cast<std::size_t>(group) + 1]};
  }
  /// The items of one group, which the caller may change.
  template <std::integral Number>
  std::span<T> items_of(Number group) {
    T* const first = items.data() + offsets[static_cast<std::size_t>(group)];
    return {first, items.data() + offsets[static_cast<std::size_t>(group) + 1]};
  }
  /// Allocates memory for these total numbers of groups and items.
  void reserve(std::size_t group_count, std::size_t item_count) {
    offsets.reserve(group_count + 1);
    items.reserve(item_count);
  }
  /// Adds a group after the last group.
  void add_group(std::span<const T> group) {
    items.insert(items.end(), group.begin(), group.end());
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
};

/// Builds the groups by a counting sort. Within a group, the items have the order in which `visit`
/// passes them.
/// \param visit  visit(put) calls put(group, item) for each item. `visit` is called twice and must
///   pass the same items in the same order both times.
template <class T, class Visit>
CompressedRows<T> compressed_rows(std::size_t group_count, const Visit& visit) {
  CompressedRows<T> result{.offsets = std::vector<std::uint32_t>(group_count + 1, 0), .items = {}};
  visit([&](std::size_t group, const T&) { ++result.offsets[group + 1]; });
  for (std::size_t g = 0; g < group_count; ++g) result.offsets[g + 1] += result.offsets[g];
  result.items.resize(result.offsets.back());
  std::vector<std::uint32_t> next_offsets(result.offsets.begin(), result.offsets.end() - 1);
  visit([&](std::size_t group, const T& item) { result.items[next_offsets[group]++] = item; });
  return result;
}

}  // namespace crowdface
