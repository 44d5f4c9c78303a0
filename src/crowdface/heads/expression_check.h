// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Warns about heads whose expression does not seem neutral: around the mouth or the eyes, the
/// shape of such a head, after a similarity fit, differs from the vertex-wise median of all heads
/// far more than the other heads' shapes do. With fewer than four heads there are no warnings,
/// because an outlier cannot be determined.
/// \param skin  #V, whether each vertex is skin
/// \param mm    millimetres per file unit
std::vector<std::string> odd_expressions(const HeadSet& heads, const std::vector<bool>& skin,
                                         const HeadAxes& axes, double mm);

}  // namespace crowdface
