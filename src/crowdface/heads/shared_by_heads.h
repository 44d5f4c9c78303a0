// SPDX-License-Identifier: Apache-2.0
// Computes data from all heads together. Because this takes about a second per million vertices,
// the results for large heads are cached.
#pragma once

#include "crowdface/cast/sample_cells.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/find_mirror.h"

namespace crowdface {

/// Sets the adjacency and the components of the inputs, from the cache if possible.
/// \param inputs  must have the topology and its hash
void find_neighbours(Inputs& inputs);

/// Returns the vertex weights of the regions that the config's masks paint, from the cache if
/// possible. If the config has no regions, returns `whole_head_weights`.
/// \param inputs  `inputs.parts` must be set
RegionWeights load_regions(const Config& config, const Inputs& inputs);

/// Chooses `count` samples on `mean_before_placement` (see choose_face_samples), or reads the
/// samples from the cache.
FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count);
/// Assigns the vertices of the mean head to samples (see find_sample_cells), or reads the
/// assignment from the cache.
SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples);

/// Finds the mirror partners of the mean head's vertices, or reads them from the cache.
/// \param side  direction from the right to the left of the head
FoundMirror find_cached_mirror(const Inputs& inputs, const Eigen::Vector3d& side);

}  // namespace crowdface
