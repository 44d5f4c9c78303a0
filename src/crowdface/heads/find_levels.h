// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Computes the levels of detail that the config asks for and stores them in `inputs`, whose heads
/// and shapes must already be loaded. Does nothing if no mesh is written.
/// \param cache  keeps the levels; empty: no cache
void find_levels(const Config& config, const CacheFolder& cache, Inputs& inputs);

/// A readable text with one line for each level of detail; empty if there are none.
std::string describe_detail_levels(const Inputs& inputs);

}  // namespace crowdface
