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

/// The part of a crowd that one machine makes: every `count`-th face, starting with face number
/// `index` (counted from 1).
struct Shard {
  std::uint64_t index = 1;  ///< number of this shard, counted from 1
  std::uint64_t count = 1;  ///< number of all shards; 1: the shard is the whole crowd

  bool is_whole_crowd() const { return count == 1; }
  /// Whether the shard makes the face whose index in the plan (counted from 0) is `face_index`.
  bool owns(std::size_t face_index) const { return face_index % count == index - 1; }
  /// Name such as "2of7", as in the shard's file names.
  std::string name() const;
};

/// Parses text such as "2/7"; nothing if the text is not a shard or names more than 9999 shards.
std::optional<Shard> parse_shard(std::string_view text);
/// Parses a name such as "2of7"; nothing if the text is not a shard's name or has more than 9999
/// shards.
std::optional<Shard> parse_shard_name(std::string name);

/// Converts the path of a file of the crowd to the path of the shard's file, for example
/// "ledger.jsonl" to "ledger-2of7.jsonl". Returns `path` itself if the shard is the whole crowd.
std::filesystem::path shard_path(const std::filesystem::path& path, const Shard& shard);
/// The existing files whose path is shard_path(path, shard) for any shard, sorted by name.
std::vector<std::filesystem::path> existing_shard_paths(const std::filesystem::path& path);

/// The state of a shard, according to its latest run.
enum class ShardState {
  kWaiting,  ///< no run of the shard has begun
  /// the latest run is working, or was killed without notice: only the time since its last write
  /// tells which
  kWorking,
  kDone,         ///< all faces of the shard are done
  kInterrupted,  ///< a signal stopped the latest run; the next run continues the shard
  kFailed        ///< the latest run ended with an error
};
/// The state's name in files and messages, such as "waiting".
std::string_view name_of(ShardState state);

/// What a shard reports about its latest run, during the run and at its end.
struct ShardNotes {
  ShardState state = ShardState::kWorking;
  std::uint64_t face_count = 0;           ///< number of faces in the shard
  std::uint64_t finished_face_count = 0;  ///< number of finished faces in the shard
  std::uint64_t made_face_count = 0;      ///< number of faces that this run has made in `seconds`
  double seconds = 0;                     ///< time from the start of the run to these notes
  std::string machine;
  std::string reason;  ///< why the run was interrupted or failed
};
/// Formats the notes as one line of JSON, with a line end.
std::string format_shard_notes(const ShardNotes& notes);
/// Parses the text that format_shard_notes returned.
/// \return the notes; nothing if the text is not the notes of a shard.
std::optional<ShardNotes> parse_shard_notes(std::string_view text);

}  // namespace crowdface
