// SPDX-License-Identifier: Apache-2.0
// What follows from all heads together and takes a second or so at a million vertices: looked up in the
// cache before it is computed. Of small heads nothing is kept.
#pragma once

#include <filesystem>

#include "crowdface/cast/sample_cells.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/find_mirror.h"

namespace crowdface {

/// Where it is kept, for heads of this mesh; empty: nowhere.
std::filesystem::path folder_for(const std::filesystem::path& cache, const Topology& topology);

/// As build_adjacency and find_components. \param inputs  with topology and its digest
void find_neighbours(Inputs& inputs);

/// As region_weights, of the config's masks; whole_head without regions. \param inputs  with parts
RegionWeights load_regions(const Config& config, const Inputs& inputs);

/// As choose_face_samples and find_sample_cells, of the mean head.
FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count);
SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples);

/// As find_mirror.
FoundMirror find_other_sides(const Inputs& inputs, const Eigen::Vector3d& side);

}  // namespace crowdface
