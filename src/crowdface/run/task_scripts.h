// SPDX-License-Identifier: Apache-2.0
// A crowd as tasks for the engine of a farm (docs/farm.md): prepare, plan, blend, gather.
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

/// A crowd's tasks, the same for all engines. Paths are absolute and mean the same on all machines.
struct TaskJob {
  std::filesystem::path program;
  std::vector<std::string> config;  ///< arguments: the config file and what overrides it
  std::vector<std::string> limits;  ///< arguments of every task: how large inputs may be
  std::string crowd;                ///< its name
  CrowdDirectory directory;
  std::filesystem::path cache;  ///< that all machines share
  std::string scratch;         ///< a folder of each machine's own, for the shell there; empty: none
  std::uint64_t prepares = 1;  ///< tasks that prepare heads
  std::uint64_t shards = 1;    ///< tasks that make faces
  std::uint64_t processors = 1;  ///< of a task
  std::uint64_t memory = 0;      ///< bytes of a task; 0: the engine's default
};

enum class Engine { kSlurm, kParallel };
std::string_view name_of(Engine engine);

/// What only some engines want.
struct EngineOptions {
  std::string partition, time;       ///< Slurm; empty: the site's default
  std::uint64_t grace_seconds = 60;  ///< from the signal to the time limit
  std::vector<std::string> hosts;    ///< GNU parallel: of ssh; none: this machine
  std::vector<std::string> more;     ///< arguments for the engine as they are
};

/// How many tasks make each last minutes, by what heads and faces took when it was measured
/// (docs/farm.md). \param faces  of the crowd.
std::uint64_t fitting_shards(const Config& config, const Inputs& inputs, std::uint64_t faces,
                             std::uint64_t processors);
std::uint64_t fitting_prepares(const Inputs& inputs, std::uint64_t processors);

/// Writes `submit/` of the crowd's folder: `task.sh STAGE NUMBER`, which runs one task on the machine that
/// starts the script, and `submit.sh`, which hands all tasks to the engine.
/// \return `submit.sh`, a script for bash that submits to Slurm or runs GNU parallel to its end.
std::filesystem::path write_task_scripts(const TaskJob& job, Engine engine,
                                         const EngineOptions& options);

}  // namespace crowdface
