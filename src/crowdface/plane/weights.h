// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// A point of the weight plane, on which every head has an anchor t_i and a face a position m.
using PlanePoint = Eigen::Vector2d;

/// Eq. 4, normalised: ω_i = 1/‖m − t_i‖², divided by their sum. At an anchor its head takes all the
/// weight; heads that share the anchor share the weight.
/// \param anchors   #heads, at least one.
/// \return          #heads, not negative, summing to one.
std::vector<double> inverse_square_weights(const std::vector<PlanePoint>& anchors,
                                           const PlanePoint& position);

}  // namespace crowdface
