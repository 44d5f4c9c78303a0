// SPDX-License-Identifier: Apache-2.0
// A tube as a stand-in for a neck.
#pragma once

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/neck/open_rims.h"

#include "support/meshes.h"

namespace crowdface::testing {

/// A tube of `rows` rows of quads along +y, `around` vertices in each ring, in mm. Its section is an
/// egg, so that each ring fits itself in one way only.
struct Tube {
  std::uint32_t around = 24, rows = 12;
  double radius = 60, height = 120, bottom = 0;
  double skew = 0.05;  ///< by how much the section lacks left-right symmetry

  Topology topology() const {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t y = 0; y < rows; ++y) {
      for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t a = y * around + i, b = y * around + (i + 1) % around;
        faces.push_back({a, a + around, b + around, b});
      }
    }
    return make_topology(static_cast<Index>(around) * (rows + 1), faces);
  }
  Positions positions() const {
    Positions points(static_cast<Index>(around) * (rows + 1), 3);
    for (Index v = 0; v < points.rows(); ++v) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(v % around) / around;
      const double egg = radius * (1 + 0.12 * std::cos(angle) + skew * std::sin(2 * angle));
      points.row(v) << egg * std::cos(angle),
          bottom + height * static_cast<double>(v / around) / rows, egg * std::sin(angle);
    }
    return points;
  }
  /// The lowest ring.
  Rim rim() const {
    Rim rim(around);
    std::iota(rim.begin(), rim.end(), 0U);
    return rim;
  }
};

}  // namespace crowdface::testing
