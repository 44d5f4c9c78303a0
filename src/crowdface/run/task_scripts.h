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

/// The tasks of a crowd, independent of the engine. Paths are absolute and valid on all machines.
struct TaskJob {
  std::filesystem::path program;
  std::vector<std::string> config;  ///< arguments: the config file and its overrides
  std::vector<std::string> limits;  ///< arguments for every task: maximum sizes of inputs
  std::string crowd;                ///< name of the crowd
  CrowdDirectory directory;
  std::filesystem::path cache;  ///< shared by all machines
  std::string scratch;  ///< a local folder on each machine, expanded by its shell; empty: none
  std::uint64_t prepares = 1;    ///< number of tasks that prepare heads
  std::uint64_t shards = 1;      ///< number of tasks that make faces
  std::uint64_t processors = 1;  ///< number of processors per task
  std::uint64_t memory = 0;      ///< bytes per task; 0: the engine's default
};

enum class Engine { kSlurm, kParallel };
std::string_view name_of(Engine engine);

/// Options that only some engines use.
struct EngineOptions {
  std::string partition, time;       ///< Slurm; empty: the site's default
  std::uint64_t grace_seconds = 60;  ///< time between the termination signal and the time limit
  std::vector<std::string> hosts;    ///< GNU parallel: ssh hosts; empty: this machine
  std::vector<std::string> extra_arguments;  ///< further arguments for the engine, passed unchanged
};

/// Return the number of tasks for which, by measured times (docs/farm.md), each task that makes
/// faces takes about ten minutes, or each task that prepares heads about one minute.
/// \param faces  number of faces in the crowd
std::uint64_t suitable_shard_count(const Config& config, const Inputs& inputs, std::uint64_t faces,
                                   std::uint64_t processors);
std::uint64_t suitable_prepare_count(const Inputs& inputs, std::uint64_t processors);

/// Writes `submit/` in the crowd's folder: `task.sh STAGE NUMBER` runs one task on the machine that
/// starts the script; `submit.sh` hands all tasks to the engine.
/// \return `submit.sh`, a bash script that submits to Slurm, or runs GNU parallel to completion.
std::filesystem::path write_task_scripts(const TaskJob& job, Engine engine,
                                         const EngineOptions& options);

}  // namespace crowdface
