// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// The quad mesh of a head, without vertex positions.
struct Layout {
  Topology topology;
  TextureCoordinates uvs;                    ///< #T by 2, in [0, 1]²
  std::vector<LatticePoint> lattice_points;  ///< location of each vertex on the skin patches
};

/// Makes the quad mesh of a head with about this number of vertices. The left and right halves have
/// the same number of quads.
Layout make_layout(Index vertices);

}  // namespace crowdface::synth
