// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/shard.h"

#include "crowdface/core/text.h"

namespace crowdface {

std::string Shard::name() const {
  return concat(index, "of", count);
}

std::optional<Shard> parse_shard(std::string_view text) {
  constexpr std::uint64_t kMost = 9999;
  const std::size_t slash = text.find('/');
  if (slash == text.npos) return std::nullopt;
  const auto index = parse_unsigned(text.substr(0, slash));
  const auto count = parse_unsigned(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > kMost) return std::nullopt;
  return Shard{*index, *count};
}

}  // namespace crowdface
