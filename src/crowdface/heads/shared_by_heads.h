// SPDX-License-Identifier: Apache-2.0
// Data computed from all heads together. The computation takes about a second per million vertices,
// so the data is looked up in the cache first. Nothing is cached for small heads.
#pragma once

#include "crowdface/cast/sample_cells.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/find_mirror.h"

namespace crowdface {

/// build_adjacency and find_components, cached. \param inputs  must have the topology and its hash
void find_neighbours(Inputs& inputs);

/// Returns the `region_weights` of the config's masks, from the cache if possible. If the config
/// has no regions, returns `whole_head_weights`.
/// \param inputs  `inputs.parts` must be set
RegionWeights load_regions(const Config& config, const Inputs& inputs);

/// choose_face_samples and find_sample_cells of the mean head, cached.
FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count);
SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples);

/// find_mirror, cached.
FoundMirror find_cached_mirror(const Inputs& inputs, const Eigen::Vector3d& side);

}  // namespace crowdface
