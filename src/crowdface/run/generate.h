// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "crowdface/config/config_reader.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// Where a shard has its faces from.
enum class PlanFrom {
  kFolderOrCasting,  ///< the folder's plan if it is this very job's, else the crowd is cast
  kFolder,           ///< the folder's plan, or the shard is refused
};

struct GenerateOptions {
  std::filesystem::path cache;         ///< folder of prepared heads
  Replace replace = Replace::kRefuse;  ///< what to do about another config's crowd in the folder
  bool dry_run = false;                ///< say what would be written, and write nothing
  /// Bytes the process may take, which sets how many faces are in flight; 0: three quarters of what
  /// the machine, or its control group, has.
  std::uint64_t memory = 0;
  Shard shard = {};  ///< only these faces, and neither sheets nor report: `gather` makes those
  PlanFrom plan_from = PlanFrom::kFolderOrCasting;
};

/// The whole job: read, prepare, cast, blend, write, render, report. Nothing is written before all
/// inputs are checked. What the folder's ledger proves to be done is not done again: a run that was
/// stopped goes on, and a finished crowd is repaired. \throws Error.
void generate(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
              const GenerateOptions& options);
/// The same of a config at hand, whose values are checked as those of a file are.
void generate(const Config& config, const GenerateOptions& options);

/// Checks the faces that shards have made, and makes what one run over the whole crowd would have
/// left beside them: sheets, report, one ledger.
/// \param cache  folder of prepared heads.
/// \throws MissingInput if faces are missing or altered, naming them.
void gather(const std::filesystem::path& crowd_directory, const std::filesystem::path& cache);

/// Casting only: writes config.yaml, plan.jsonl and crowd.csv into the crowd's folder.
void plan(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
          const GenerateOptions& options);
void plan(const Config& config, const GenerateOptions& options);

}  // namespace crowdface
