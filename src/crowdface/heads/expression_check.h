// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Warns about heads whose expression does not seem neutral. Mouth and eyes of each head are fitted
/// to the vertex-wise median of all heads. At the mouth and the eyes, the check compares the
/// lengths of edges with the lengths on the median. At the eyes, it also compares the positions of
/// vertices. It names a head whose differences are large compared with the differences of the other
/// heads at the same edges and vertices. On heads of the ICT model, the check finds an open,
/// smiling or pursed mouth, full cheeks and closed lids. It does not find a wrinkled nose or moved
/// brows, because the differences between people are as large. With fewer than four heads there are
/// no warnings, because an outlier cannot be determined.
/// \param skin  for each vertex, whether it is skin
/// \param mm    millimetres per file unit
std::vector<std::string> odd_expression_warnings(const HeadSet& heads,
                                                 const std::vector<bool>& skin,
                                                 const HeadAxes& axes, double mm);

}  // namespace crowdface
