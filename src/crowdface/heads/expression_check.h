// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Returns warnings about heads whose expression does not seem neutral: at most one warning for the
/// mouth and cheeks of each head, and one for its eyes and brows. Of the ICT model's expressions at
/// full strength, the check finds
///
/// - smiles, open mouths, closed lids and raised brows on nearly every head;
/// - pursed mouths and puffed cheeks on most heads;
/// - no lowered brows and no wrinkled noses, because people differ as much without any expression.
///
/// The check compares the heads with each other. It measures how far each feature (such as a corner
/// of the mouth) is displaced from the vertex-wise median of all heads, relative to the skin around
/// the feature. The check warns of a feature whose displacement is much larger than on the other
/// heads.
///
/// \param is_skin  #V, whether each vertex is skin.
/// \param axes     axes of all heads.
/// \return one text per warning; none if there are fewer than four heads, because then an outlier
///         cannot be determined, or if no face is found.
std::vector<std::string> odd_expression_warnings(const HeadSet& head_set,
                                                 const std::vector<bool>& is_skin,
                                                 const HeadAxes& axes);

}  // namespace crowdface
