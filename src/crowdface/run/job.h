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

/// A config and all inputs that the config names, already read and checked.
struct Job {
  Config config;
  Inputs inputs;
  SmoothingOperator smoothing;  ///< smoothing operator of the heads' mesh
  PlanNames names;              ///< names that the plan file writes instead of indices
  Digest settings;              ///< hash of the settings, see settings_digest
};

/// Reads the config, heads and masks. Adds every problem that it finds to `problems`.
/// \param cache  folder that caches the heads that were read (see cache_directory); empty: no cache
/// \return nothing if there is any problem.
std::optional<Job> load_job(const std::filesystem::path& config_file,
                            const ConfigOverrides& overrides, const CacheFolder& cache,
                            Problems& problems);
/// Reads the config, heads and masks. \throws Error that lists all problems that were found.
Job load_job(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
             const CacheFolder& cache = {});

/// Loads the job of a config object. The config is written as text and read again, so that the
/// values and paths are validated in the same way as in a config file.
Job load_job(const Config& config, const CacheFolder& cache = {},
             const ConfigOverrides& overrides = {});

/// The number of faces that the config asks for.
std::uint64_t face_count(const Config& config);

/// Returns the paths of the files in the config's output folder.
CrowdDirectory crowd_directory_of(const Config& config);

/// Returns the text of the config.yaml that a run writes into the crowd's folder. In this text, the
/// paths of the review files are the paths of their copies in the crowd's folder.
std::string stored_config_text(Config config, const CrowdDirectory& directory);
/// Returns the texts of config.yaml and of the review files that a run writes into the crowd's
/// folder, and a function that compares the config with the config.yaml that is already there.
CrowdConfig crowd_config(const Config& config, const CrowdDirectory& directory);

/// The scale that converts a smoothness into a number of smoothing iterations on these heads.
SmoothingLevelScale level_scale(const Config& config, const Inputs& inputs);

}  // namespace crowdface
