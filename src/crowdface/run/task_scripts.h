// SPDX-License-Identifier: Apache-2.0
// Splits a crowd into tasks for the job engine of a render farm (docs/farm.md): prepare, plan,
// blend, gather.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The tasks that make a crowd, independent of the job engine. Paths are absolute and valid on all
/// machines.
struct TaskJob {
  std::filesystem::path program;  ///< the crowdface executable
  /// words of every task's command line: the config file and the overrides of its values
  std::vector<std::string> config_arguments;
  /// words of every task's command line that limit the sizes of inputs (`--limit`)
  std::vector<std::string> input_limit_arguments;
  std::string crowd_name;  ///< name of the crowd
  CrowdDirectory directory;
  std::filesystem::path cache;  ///< folder of prepared heads, shared by all machines
  /// a local folder on each machine; the machine's shell expands the path; empty: none
  std::string scratch_folder;
  std::uint64_t prepare_task_count = 1;  ///< number of tasks that prepare heads
  std::uint64_t shard_count = 1;         ///< number of tasks that make faces
  std::uint64_t processor_count = 1;     ///< number of processors per task
  std::uint64_t memory_bytes = 0;        ///< memory of each task; 0: the engine's default
};

/// The program that runs the tasks: Slurm or GNU parallel.
enum class JobEngine { kSlurm, kParallel };
/// The name of an engine as a command option: "slurm" or "parallel".
std::string_view name_of(JobEngine engine);

/// Options for the render farm's job engine; some engines use only part of them.
struct JobEngineOptions {
  std::string partition, time_limit;  ///< only for Slurm; empty: the default of the Slurm site
  /// only for Slurm: seconds between SIGTERM and the time limit of a task
  std::uint64_t grace_seconds = 60;
  std::vector<std::string> hosts;  ///< only for GNU parallel: ssh hosts; empty: this machine
  std::vector<std::string> extra_arguments;  ///< further arguments for the engine, passed unchanged
};

/// Returns the number of tasks (shards) into which to split the making of faces, so that each task
/// takes about ten minutes. The estimate is based on measured times (docs/farm.md).
/// \param faces  number of faces in the crowd
std::uint64_t suitable_shard_count(const Config& config, const Inputs& inputs, std::uint64_t faces,
                                   std::uint64_t processor_count);
/// Returns the number of tasks into which to split the preparation of heads, so that each task
/// takes about one minute.
std::uint64_t suitable_prepare_task_count(const Inputs& inputs, std::uint64_t processor_count);

/// Writes two bash scripts into `submit/` in the crowd's folder. `task.sh STAGE NUMBER` runs one
/// task on the machine that starts the script. `submit.sh` submits all tasks to Slurm, or runs all
/// tasks to completion with GNU parallel.
/// \return the path of `submit.sh`.
std::filesystem::path write_task_scripts(const TaskJob& job, JobEngine engine,
                                         const JobEngineOptions& options);

}  // namespace crowdface
