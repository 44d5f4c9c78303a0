// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Warns about heads whose expression does not seem neutral. Mouth and eyes of each head are fitted
/// to the vertex-wise median of all heads. At the mouth the lengths of edges are compared with
/// those of the median, at the eyes also the positions of vertices. A head is named if its differences
/// are large compared with those of the other heads at the same edges and vertices. On heads of the
/// ICT model this finds an open, smiling or pursed mouth, full cheeks and closed lids; a wrinkled
/// nose and moved brows are not larger than the differences between people. With fewer than four
/// heads there are no warnings, because an outlier cannot be determined.
/// \param skin  #V, whether each vertex is skin
/// \param mm    millimetres per file unit
std::vector<std::string> odd_expressions(const HeadSet& heads, const std::vector<bool>& skin,
                                         const HeadAxes& axes, double mm);

}  // namespace crowdface
