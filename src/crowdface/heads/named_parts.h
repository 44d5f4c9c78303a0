// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Assigns the components of the heads to the parts that the config names, and stores the result in
/// `inputs.parts` and `inputs.skin_components`. A name without a matching component is a problem.
void find_named_parts(const Config& config, Inputs& inputs, Problems& problems);

/// For each vertex of the heads, whether the vertex belongs to the skin.
std::vector<bool> skin_of(const Inputs& inputs);
/// Indices of the vertices that belong to the skin, ascending.
std::vector<std::uint32_t> skin_vertices(const Inputs& inputs);

/// The axes of the heads, as configured.
HeadAxes head_axes(const Config& config);

/// A readable summary: one line for the skin, and one line for each group of similar parts.
std::string describe_parts(const Config& config, const Inputs& inputs);

}  // namespace crowdface
