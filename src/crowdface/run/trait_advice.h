// SPDX-License-Identifier: Apache-2.0
// Advice if the limits on measurements cannot be met.
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/casting_result.h"
#include "crowdface/run/face_traits.h"

namespace crowdface {

/// Explains why limits could not be met: a line for each limit, with the share of sampled faces
/// that meet the limit, the range of these faces, and the heads that reach farthest.
/// \param shortfall  names the group, family or recipe whose limits bind
std::vector<std::string> trait_advice(const Config& config, const Inputs& inputs,
                                      const CastingOptions& casting, const FaceTraits& traits,
                                      const Shortfall& shortfall);

}  // namespace crowdface
