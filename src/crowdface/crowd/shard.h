// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// A machine's part of a crowd: every `count`-th face, beginning with the `index`-th.
struct Shard {
  std::uint64_t index = 1;  ///< from 1
  std::uint64_t count = 1;  ///< 1: the whole crowd

  bool whole() const { return count == 1; }
  /// Whether the face at this place of the plan, from 0, is this shard's.
  bool owns(std::size_t face) const { return face % count == index - 1; }
  /// "2of7", as in the names of its files.
  std::string name() const;
};

/// "2/7"; nothing if it is no shard, or one of more than 9999.
std::optional<Shard> parse_shard(std::string_view text);

}  // namespace crowdface
