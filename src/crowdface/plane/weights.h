// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// A point of the weight plane. Every head has a fixed point (anchor) t_i on this plane. Every
/// region of a face has a position m, whose distances from the anchors give the heads' weights.
using PlanePoint = Eigen::Vector2d;

/// Returns the normalised weights of the heads at a position of the weight plane (Eq. 4). The
/// weight of head i is 1/‖m − t_i‖², divided by the sum of these values over all heads. Here, m is
/// the position and t_i is the anchor of head i. If the position is at an anchor, the anchor's head
/// has weight one. If several heads have this anchor, they share the weight equally.
///
/// \param anchors   t_i, one anchor per head; at least one.
/// \param position  m.
/// \return          one weight per head, not negative, summing to one.
std::vector<double> inverse_square_weights(const std::vector<PlanePoint>& anchors,
                                           const PlanePoint& position);

}  // namespace crowdface
