// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/mesh/topology.h"

#include "support/meshes.h"

namespace crowdface::testing {

/// A square sheet around the origin, `side` quads to a side of length 2, at height z.
struct Sheet {
  explicit Sheet(std::uint32_t side) : topology(grid_topology(side, side)) {
    positions.resize(topology.vertex_count, 3);
    for (Index v = 0; v < topology.vertex_count; ++v) {
      positions.row(v) << 2.0 * static_cast<double>(v % (side + 1)) / side - 1,
          2.0 * static_cast<double>(v / (side + 1)) / side - 1, 0;
    }
  }
  Topology topology;
  Positions positions;
};

/// A sheet folded along x = 0, so that its halves lie a hundredth apart: two lips.
inline Sheet folded_sheet(std::uint32_t side) {
  Sheet sheet(side);
  for (Index v = 0; v < sheet.positions.rows(); ++v) {
    const double x = sheet.positions(v, 0);
    sheet.positions(v, 0) = std::abs(x);
    sheet.positions(v, 2) = x < 0 ? 0.01 : 0;
  }
  return sheet;
}

}  // namespace crowdface::testing
