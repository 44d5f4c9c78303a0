// SPDX-License-Identifier: Apache-2.0
// Advice for the user if no faces satisfy the config's limits on measurements.
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/casting_result.h"
#include "crowdface/run/face_traits.h"

namespace crowdface {

/// Explains why limits on measurements could not be met. Returns a line for each limit, with the
/// share of sampled faces that meet the limit, the range of the sampled faces' values, and the
/// heads with the most extreme values.
/// \param shortfall  names the group, family or recipe whose limits could not be met
std::vector<std::string> trait_advice(const Config& config, const Inputs& inputs,
                                      const CastingOptions& casting, const FaceTraits& traits,
                                      const Shortfall& shortfall);

}  // namespace crowdface
