// SPDX-License-Identifier: Apache-2.0
// The progress of a crowd on all machines. The crowd's folder is the only source of information.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/crowd/shard.h"

namespace crowdface {

/// The progress of one shard.
struct ShardStatus {
  Shard shard;
  ShardState state = ShardState::kWaiting;
  std::uint64_t face_count = 0;           ///< number of planned faces in the shard
  std::uint64_t finished_face_count = 0;  ///< number of finished faces according to all ledgers
  std::optional<double> faces_a_second;   ///< faces per second in the last run
  /// time until the shard finishes; nothing if the shard is not working or its speed is unknown
  std::optional<double> seconds_left;
  /// time since the shard's last write; nothing if the shard is not working
  std::optional<double> seconds_since_write;
  std::string machine;  ///< name of the machine of the last run
  std::string reason;   ///< why the last run ended early
  /// Whether the last run ended early and Slurm will run the shard's task again.
  bool is_requeued = false;

  /// The state for users: "requeued", or the name of `state`.
  std::string_view state_name() const { return is_requeued ? "requeued" : name_of(state); }
};

/// The progress of a whole crowd.
struct CrowdStatus {
  bool is_planned = false;  ///< whether the plan exists
  /// whether the report exists (a run writes the report after all faces and sheets)
  bool is_report_written = false;
  std::uint64_t face_count = 0;           ///< number of faces in the plan
  std::uint64_t finished_face_count = 0;  ///< number of finished faces according to all ledgers
  /// all shards; empty if a single run makes the crowd or no run has begun
  std::vector<ShardStatus> shards;
  std::optional<double> faces_a_second;  ///< faces per second, summed over all working shards
  std::optional<double> seconds_left;    ///< time until the last working shard finishes
  std::vector<std::string> failures;     ///< last error of each failed task that is not a shard
};

/// How the last attempt to run a task ended, according to the task's log.
struct TaskEnd {
  /// exit code of the task; nothing if the task has not ended
  std::optional<std::uint64_t> exit_code;
  std::string reason;        ///< last error in the task's log
  bool is_requeued = false;  ///< whether the task has asked Slurm for another run
};
/// Finds the end of the last attempt in the text of a task's log.
TaskEnd parse_task_end(std::string_view log);

/// Reads the status from the folder and changes nothing. Needs neither the heads nor locks.
/// \throws MissingInput if the folder is not a crowd's folder; IoError.
CrowdStatus crowd_status(const std::filesystem::path& crowd_directory);

}  // namespace crowdface
