// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Sorts the components of the heads into parts as the config asks, into `inputs.parts` and
/// `inputs.skin`. A name that no component bears is a problem.
void find_named_parts(const Config& config, Inputs& inputs, Problems& problems);

/// Whether each vertex is skin, #V; and those that are, ascending.
std::vector<bool> skin_of(const Inputs& inputs);
std::vector<std::uint32_t> skin_vertices(const Inputs& inputs);

/// Which way the heads look, as the config says.
HeadAxes head_axes(const Config& config);

/// What was found, a line for the skin and one for each group of like parts, for people to read.
std::string describe_parts(const Config& config, const Inputs& inputs);

}  // namespace crowdface
