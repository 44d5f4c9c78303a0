// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// Ambient visibility of some vertices: the cosine-weighted fraction of the hemisphere above the
/// surface that is free of obstacles, 0 … 1. Visibility is small between lips, in nostrils and at
/// teeth. Polygons of kind kHidden are not obstacles.
/// \param kinds      the kind of each polygon; if empty, all polygons are skin.
/// \param positions  #V by 3, any unit.
/// \return           one value for each of `vertices`.
std::vector<float> vertex_visibility(const Topology& topology,
                                     const std::vector<SurfaceKind>& kinds,
                                     const Positions& positions,
                                     std::span<const std::uint32_t> vertices);

}  // namespace crowdface
