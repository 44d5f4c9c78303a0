// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/core/problems.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/job/config_reader.h"
#include "crowdface/job/head_textures.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Everything a job reads, checked: heads, their topology, masks, and what follows from them.
struct Inputs {
  FaceSet faces;
  std::vector<ObjFile> files;          ///< #heads; topology and positions have moved to `faces`
  std::vector<std::string> materials;  ///< #F, the first head's material of each face
  Adjacency adjacency;
  Components components;
  PartList parts;   ///< `parts: none`: empty
  Components skin;  ///< the components with all skin joined into the largest
  RegionWeights regions;
  std::vector<double> distance_mask;  ///< #V, from `distance.mask`; empty without
  double edge_length_mm = 0;          ///< rms edge length of the skin, averaged over the heads
  std::uint64_t max_level = 0;        ///< L_max
  std::vector<Digest> head_digests;   ///< #heads, of the positions used
  Digest topology_digest;
  Digest mask_digest;                 ///< of α
  HeadTextures textures;              ///< if pictures are to show them
  std::vector<std::string> warnings;  ///< in a fixed order; also logged
};

/// Reads heads (in parallel) and masks and checks them. Every problem is added; warnings are logged
/// and kept.
/// \return nothing if there is any problem.
std::optional<Inputs> load_inputs(const Config& config, Problems& problems);

/// Only adds the problems of the heads and masks that a config names, as far as it is known: what a
/// user should hear together with what is wrong in the config.
void check_inputs(const ConfigReading& reading, Problems& problems);

/// The hash of what a mesh depends on beside its recipe: topology, heads, masks, and the smoothing
/// settings. Each recipe of a plan carries it.
Digest settings_digest(const Config& config, const Inputs& inputs);

}  // namespace crowdface
