// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Warns about heads whose expression does not seem neutral: an open or pursed mouth, raised or
/// lowered corners of the mouth, puffed cheeks, closed or widely opened eyes, and raised brows.
/// Each of these movements is measured as the displacement of a feature from the vertex-wise
/// median of all heads, minus the displacement of the skin around the feature. A head is named if
/// its value is large compared with the values of the other heads. Of the ICT model's expressions
/// at full strength, smiles, open mouths, closed lids and raised brows are found on every head or
/// nearly every head, pursed mouths and puffed cheeks on most heads. Lowered brows and a wrinkled
/// nose are not larger than the differences between people. With fewer than four heads there are
/// no warnings, because an outlier cannot be determined.
/// \param skin  #V, whether each vertex is skin
std::vector<std::string> odd_expression_warnings(const HeadSet& heads,
                                                 const std::vector<bool>& skin,
                                                 const HeadAxes& axes);

}  // namespace crowdface
