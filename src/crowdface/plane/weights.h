// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// A point of the weight plane. Every head has a fixed point (anchor) t_i on this plane. Every
/// region of a face has a position m, whose distances from the anchors give the heads' weights.
using PlanePoint = Eigen::Vector2d;

/// Returns the weights of Eq. 4, normalised: 1/‖m − t_i‖², divided by the sum over all i. If the
/// position is at an anchor, the anchor's head has weight one. If several heads have this anchor,
/// they share the weight equally.
///
/// \param anchors   one anchor per head; at least one.
/// \return          one weight per head, not negative, summing to one.
std::vector<double> inverse_square_weights(const std::vector<PlanePoint>& anchors,
                                           const PlanePoint& position);

}  // namespace crowdface
