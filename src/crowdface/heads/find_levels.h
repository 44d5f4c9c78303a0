// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The levels of detail that the config asks for, into inputs whose heads and shapes are known; none
/// where no mesh is written.
/// \param cache  where they are kept; empty: nowhere
void find_levels(const Config& config, const CacheFolder& cache, Inputs& inputs);

/// A line for each, for people to read; empty without.
std::string describe_levels(const Inputs& inputs);

}  // namespace crowdface
