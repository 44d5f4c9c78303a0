// SPDX-License-Identifier: Apache-2.0
#include "crowdface/plane/weights.h"

#include <algorithm>

#include "crowdface/core/require.h"

namespace crowdface {

std::vector<double> inverse_square_weights(const std::vector<PlanePoint>& anchors,
                                           const PlanePoint& position) {
  require(!anchors.empty(), "weights: no anchor");
  std::vector<double> weights(anchors.size());
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const double dx = position.x() - anchors[i].x();
    const double dy = position.y() - anchors[i].y();
    weights[i] = dx * dx + dy * dy;  // ‖m − t_i‖²
  }
  const double nearest = *std::ranges::min_element(weights);
  double sum = 0;
  for (double& weight : weights) {
    // Eq. 4, multiplied by the squared distance of the nearest anchor, so that no quotient
    // overflows.
    weight = nearest > 0 ? nearest / weight : (weight == 0 ? 1.0 : 0.0);
    sum += weight;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace crowdface
