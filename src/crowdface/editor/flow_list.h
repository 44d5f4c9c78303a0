// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Where a list in brackets stands in a YAML text, and its items, in bytes. Ends are one past the last.
struct FlowList {
  struct Item {
    std::size_t begin = 0, end = 0;
  };
  std::size_t begin = 0, end = 0;  ///< with its brackets
  std::vector<Item> items;
  std::size_t last_comma = 0;  ///< one past the comma after the last item; 0: there is none
};

/// \param text   YAML that was parsed without complaint.
/// \param begin  of the bracket that opens the list.
FlowList find_flow_list(std::string_view text, std::size_t begin);

/// The text with one item more at the list's end, on a line of its own where the last has one.
/// \param item  its lines.
std::string with_item(std::string_view text, const FlowList& list,
                      const std::vector<std::string>& item);
/// The text with another item in place of one.
std::string with_item_in_place(std::string_view text, const FlowList::Item& old,
                               const std::vector<std::string>& item);

}  // namespace crowdface
