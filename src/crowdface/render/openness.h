// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// How much of the sky above its surface each of some vertices sees, 0 … 1: small between lips, in nostrils
/// and at teeth. What pictures do not show hides nothing.
/// \param kinds      #F, or empty: all skin.
/// \param positions  #V by 3, any unit.
std::vector<float> vertex_openness(const Topology& topology, const std::vector<SurfaceKind>& kinds,
                                   const Positions& positions,
                                   std::span<const std::uint32_t> vertices);

}  // namespace crowdface
