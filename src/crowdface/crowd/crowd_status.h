// SPDX-License-Identifier: Apache-2.0
// How far a crowd is that machines are at work on, from its folder alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/crowd/shard.h"

namespace crowdface {

struct ShardStatus {
  Shard shard;
  ShardState state = ShardState::kWaiting;
  std::uint64_t faces = 0;
  std::uint64_t done = 0;                ///< by the lines of all ledgers
  std::optional<double> faces_a_second;  ///< of its last run
  std::optional<double> seconds_left;    ///< while it is at work and its pace is known
  std::optional<double>
      silent_seconds;  ///< while it is at work: since it last wrote, by this clock
  std::string machine;
  std::string reason;  ///< why its last run ended before it was done
};

struct CrowdStatus {
  bool planned = false;                  ///< the plan is there
  bool gathered = false;                 ///< the report is there: all is done
  std::uint64_t faces = 0;               ///< in the plan
  std::uint64_t done = 0;                ///< by the lines of all ledgers
  std::vector<ShardStatus> shards;       ///< none: one run over all, or none yet
  std::optional<double> faces_a_second;  ///< of all shards that are at work
  std::optional<double> seconds_left;    ///< until the last of them is done
  std::vector<std::string> failures;     ///< of tasks that are no shards, the last words of each
};

/// What a task's log says of its last attempt.
struct TaskEnd {
  std::optional<std::uint64_t> code;  ///< none: it has not ended
  std::string reason;                 ///< the last error it told of
};
TaskEnd end_of_task(std::string_view log);

/// Reads the folder and changes nothing; needs neither heads nor locks.
/// \throws MissingInput if it is no crowd's folder; IoError.
CrowdStatus crowd_status(const std::filesystem::path& crowd_directory);

}  // namespace crowdface
