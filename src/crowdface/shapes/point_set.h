// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Named places beside a mesh that faces shall have too: joints, pivots of eyes, ear rings.
struct PointSet {
  std::vector<std::string> names;
  /// #names by 3 each, and the mesh beside which they stand, #V by 3: those of one template for all faces,
  /// or of each head for the faces built on it.
  std::vector<Positions> positions, meshes;

  bool empty() const { return names.empty(); }
};

}  // namespace crowdface
