// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Reads (in parallel) and checks heads and masks. Adds every problem to the list; logs each
/// warning and stores it in the result.
/// \param cache  folder that keeps what was read (see cache_directory); empty: no cache
/// \return nothing if there is any problem.
std::optional<Inputs> load_inputs(const Config& config, const CacheFolder& cache,
                                  Problems& problems);

/// Reads only the heads and compares them with each other, without alignment. Adds every problem.
/// \return nothing if there is any problem.
std::optional<HeadSet> load_head_set(const Config::Faces& faces, const CacheFolder& cache,
                                     Problems& problems);

/// Adds the problems of the heads and masks that a config names, even if the config itself has
/// errors, so that users see all problems at once.
void check_inputs(const ConfigReading& reading, const CacheFolder& cache, Problems& problems);

}  // namespace crowdface
