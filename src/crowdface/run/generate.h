// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "crowdface/config/config_reader.h"
#include "crowdface/crowd/replace.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// Where a run gets the plan of its faces.
enum class PlanSource {
  /// the run uses the plan in the crowd's folder; if the folder has no plan of this job, the run
  /// casts
  kFolderOrCasting,
  /// the run uses the plan in the crowd's folder; if the folder has no plan of this job, the run
  /// fails
  kFolder,
};

struct GenerateOptions {
  std::filesystem::path cache;         ///< folder of prepared heads
  Replace replace = Replace::kRefuse;  ///< what to do if the folder has another config's crowd
  bool dry_run = false;                ///< report what would be written, and write nothing
  /// Maximum memory of the process in bytes, which determines how many faces are processed at the
  /// same time. 0: three quarters of the memory of the machine or its control group.
  std::uint64_t memory_bytes = 0;
  Shard shard = {};  ///< only this shard's faces are made; sheets and report are left to `gather`
  PlanSource plan_source = PlanSource::kFolderOrCasting;
};

/// Runs the whole job: read, prepare, cast, blend, write, render, report. Writes nothing until all
/// inputs are checked. Skips work that the ledger in the folder records as done. A repeated run
/// therefore resumes a stopped run or repairs a finished crowd. \throws Error.
void generate(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
              const GenerateOptions& options);
/// Runs the job of a config object. Validates the object's values like the values of a config file.
void generate(const Config& config, const GenerateOptions& options);

/// Checks the faces that shards have made. Then adds the files that no shard makes: sheets, report,
/// and one ledger for the whole crowd.
/// \param cache  folder of prepared heads
/// \throws MissingInput that names missing or altered faces.
void gather(const std::filesystem::path& crowd_directory, const std::filesystem::path& cache);

/// Casts a crowd without building faces: writes config.yaml, plan.jsonl and crowd.csv into the
/// crowd's folder. The overloads take the name of a config file, or a config.
void plan(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
          const GenerateOptions& options);
void plan(const Config& config, const GenerateOptions& options);

}  // namespace crowdface
