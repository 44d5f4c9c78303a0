// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// A point of the weight plane, on which every head has an anchor t_i and every face has a position
/// m.
using PlanePoint = Eigen::Vector2d;

/// Eq. 4, normalised: 1/‖m − t_i‖² divided by the sum over all i. At an anchor, the anchor's head
/// gets weight one; heads with the same anchor get equal parts of this weight.
/// \param anchors   #heads, at least one.
/// \return          #heads, not negative, summing to one.
std::vector<double> inverse_square_weights(const std::vector<PlanePoint>& anchors,
                                           const PlanePoint& position);

}  // namespace crowdface
