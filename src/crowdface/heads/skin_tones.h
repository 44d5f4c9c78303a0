// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The mean optical density of each head's colour textures; empty if faces have no blended colour
/// textures. Reads only one texel of each block of 16 by 16 texels.
std::vector<double> skin_tones(const Inputs& inputs);

/// Computes the weights of the heads in the colours of a face. A head's weight is the mean of its
/// weights in all regions; each region counts in proportion to its frontal skin area.
class HeadColourWeights {
 public:
  HeadColourWeights(const Config& config, const Inputs& inputs);
  /// The weight of each head for a face; the weights sum to one.
  std::vector<double> weights_of(const Recipe& recipe) const;

 private:
  std::size_t head_count_;                     ///< number of heads
  std::vector<double> region_area_fractions_;  ///< each region's fraction of the frontal skin area
};

}  // namespace crowdface
