// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// Number of quads in every lattice interval and ring span of a layout.
struct QuadCounts {
  /// \param quads_per_unit  density of quads. In each interval, the number of quads is rounded, and
  ///                        is at least one.
  explicit QuadCounts(double quads_per_unit);

  /// Returns the number of quads from the midline to lattice column k; negative if k < 0.
  int column(int k) const;
  /// Returns the number of quads from the cap to lattice row k.
  int row(int k) const;
  /// Returns the coordinate b (see Address) of every ring of an opening, without the opening's
  /// outline (b = 0).
  std::vector<double> rings(Sheet sheet) const;
  /// Returns the number of vertices of the whole layout.
  Index vertices() const;

  double scale;  ///< quads per unit
  std::array<int, kColumns - 1> columns{};
  std::array<int, kRows - 1> rows{};
};

/// Returns the quad counts of the layout whose number of vertices is nearest to `wanted`.
QuadCounts nearest_counts(Index wanted);

}  // namespace crowdface::synth
