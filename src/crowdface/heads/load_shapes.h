// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Reads the shapes that a config names, in parallel, into inputs whose faces and parts are known. What
/// a head lacks is carried to it from the template. Every problem
/// is added: a mesh that cannot be read, or is not in the heads' topology.
/// \param cache  the folder that keeps what was read; empty: none
void load_shapes(const Config& config, const std::filesystem::path& cache, Inputs& inputs,
                 Problems& problems);

}  // namespace crowdface
