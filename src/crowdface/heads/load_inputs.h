// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Reads heads (in parallel) and masks and checks them. Every problem is added; warnings are logged
/// and kept.
/// \param cache  the folder that keeps what was read, see cache_directory; empty: none.
/// \return nothing if there is any problem.
std::optional<Inputs> load_inputs(const Config& config, const CacheFolder& cache,
                                  Problems& problems);

/// Heads alone, compared with each other but not aligned. Every problem is added.
/// \return nothing if there is any problem.
std::optional<FaceSet> load_faces(const Config::Faces& faces, const CacheFolder& cache,
                                  Problems& problems);

/// Only adds the problems of the heads and masks that a config names, as far as it is known: what a
/// user should hear together with what is wrong in the config.
void check_inputs(const ConfigReading& reading, const CacheFolder& cache, Problems& problems);

}  // namespace crowdface
