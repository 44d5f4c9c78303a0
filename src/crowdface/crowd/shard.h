// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
/// "2of7", likewise.
std::optional<Shard> shard_of_name(std::string name);

/// A shard's own file beside one of the crowd's, which it is if the shard is the whole crowd:
/// "ledger-2of7.jsonl" beside "ledger.jsonl".
std::filesystem::path of_shard(const std::filesystem::path& path, const Shard& shard);
/// Those of all shards that are there, by name.
std::vector<std::filesystem::path> of_all_shards(const std::filesystem::path& path);

enum class ShardState {
  kWaiting,      ///< no run of it has begun
  kWorking,      ///< or killed without a word: how long it has been silent tells
  kDone,         ///< all its faces are done
  kInterrupted,  ///< ended by a signal; goes on when it is run again
  kFailed
};
std::string_view name_of(ShardState state);

/// What a shard says of its last run, while it is at work and at its end.
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
