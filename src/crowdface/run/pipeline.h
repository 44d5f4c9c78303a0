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

/// A config and all the inputs that it names, read and checked.
struct Job {
  Config config;
  Inputs inputs;
  SmoothingOperator smoothing;
  PlanNames names;
  Digest settings;  ///< hash of the settings, see settings_digest
};

/// Reads the config, heads and masks. Adds every problem.
/// \param cache  folder that keeps heads as they were read (see cache_directory); empty: no cache
/// \return nothing if there is any problem.
std::optional<Job> load_job(const std::filesystem::path& config_file,
                            const ConfigOverrides& overrides, const CacheFolder& cache,
                            Problems& problems);
/// \throws Error with all problems.
Job load_job(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
             const CacheFolder& cache = {});

/// Loads the job of a config object. The config is written as text and read again, so that its
/// values and paths are validated like a config file's.
Job load_job(const Config& config, const CacheFolder& cache = {},
             const ConfigOverrides& overrides = {});

/// The number of faces that the config asks for.
std::uint64_t face_count(const Config& config);

/// The folder of the config's crowd.
CrowdDirectory directory_of(const Config& config);

/// The text of the config for the crowd's folder; its reviews are the copies in this folder.
std::string config_text_in_folder(Config config, const CrowdDirectory& directory);
CrowdConfig crowd_config(const Config& config, const CrowdDirectory& directory);

/// Converts a smoothness into a number of iterations on these heads.
LevelScale level_scale(const Config& config, const Inputs& inputs);

}  // namespace crowdface
