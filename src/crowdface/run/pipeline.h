// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/config/config.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/plan_file.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/heads/prepare.h"

namespace crowdface {

/// A config with everything it names, read and checked.
struct Job {
  Config config;
  Inputs inputs;
  SmoothingOperator smoothing;
  PlanNames names;
  Digest settings;  ///< see settings_digest
};

/// Reads config, heads and masks. Every problem is added.
/// \param cache  the folder that keeps heads as they were read, see cache_directory; empty: none.
/// \return nothing if there is any problem.
std::optional<Job> load_job(const std::filesystem::path& config_file,
                            const ConfigOverrides& overrides, const CacheFolder& cache,
                            Problems& problems);
/// \throws Error with all problems.
Job load_job(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
             const CacheFolder& cache = {});

/// The same of a config at hand. What it says is checked as the text of a file is, of which its paths are: it is
/// written out and read again.
Job load_job(const Config& config, const CacheFolder& cache = {});

/// How many faces the config asks for.
std::uint64_t face_count(const Config& config);

/// Where its crowd lies.
CrowdDirectory directory_of(const Config& config);

/// The config as it will stand in that folder, which keeps the reviews.
std::string config_in_folder(Config config, const CrowdDirectory& directory);
CrowdConfig crowd_config(const Config& config, const CrowdDirectory& directory);

/// What turns a smoothness into iterations on these heads.
LevelScale level_scale(const Config& config, const Inputs& inputs);

}  // namespace crowdface
