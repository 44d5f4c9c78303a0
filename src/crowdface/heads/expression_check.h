// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Warnings about heads that seem to grimace where the others are neutral: around mouth or eyes such a head differs from
/// the middle of all heads in form, not only in place and size, far more than the others do. Of fewer than four heads
/// nobody can tell which one is odd.
/// \param skin  #V
/// \param mm    of one unit
std::vector<std::string> odd_expressions(const FaceSet& faces, const std::vector<bool>& skin,
                                         const HeadAxes& axes, double mm);

}  // namespace crowdface
