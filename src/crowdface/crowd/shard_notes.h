// SPDX-License-Identifier: Apache-2.0
// What a shard says of itself while it is at work.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

enum class ShardState {
  kWaiting,      ///< no run of it has begun
  kWorking,      ///< or killed without a word: how long it has been silent tells
  kDone,         ///< all its faces are done
  kInterrupted,  ///< ended by a signal; goes on when it is run again
  kFailed
};
std::string_view name_of(ShardState state);

/// Of a shard's last run.
struct ShardNotes {
  ShardState state = ShardState::kWorking;
  std::uint64_t faces = 0;  ///< of the shard
  std::uint64_t done = 0;   ///< of them
  std::uint64_t made = 0;   ///< by this run, in so many seconds
  double seconds = 0;
  std::string machine;
  std::string reason;  ///< why it is interrupted or failed
};
/// One line of JSON, with its end.
std::string format_shard_notes(const ShardNotes& notes);
/// \return nothing if the text is none of ours.
std::optional<ShardNotes> parse_shard_notes(std::string_view text);

}  // namespace crowdface
