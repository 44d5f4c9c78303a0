// SPDX-License-Identifier: Apache-2.0
// Data computed from all heads together. The computation takes about a second per million vertices,
// so the data is looked up in the cache first. Nothing is cached for small heads.
#pragma once

#include "crowdface/cast/sample_cells.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/find_mirror.h"

namespace crowdface {

/// Stores the results of build_adjacency and find_components in the inputs, from the cache if
/// possible.
/// \param inputs  must have the topology and its hash
void find_neighbours(Inputs& inputs);

/// Returns the `region_weights` of the config's masks, from the cache if possible. If the config
/// has no regions, returns `whole_head_weights`.
/// \param inputs  `inputs.parts` must be set
RegionWeights load_regions(const Config& config, const Inputs& inputs);

/// Like choose_face_samples and find_sample_cells for the mean head, but from the cache if
/// possible.
FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count);
SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples);

/// Like find_mirror, but from the cache if possible.
FoundMirror find_cached_mirror(const Inputs& inputs, const Eigen::Vector3d& side);

}  // namespace crowdface
