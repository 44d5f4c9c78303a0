// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// Number of quads in every lattice interval and ring span of a layout.
struct QuadCounts {
  /// \param density  quads per lattice unit (see lattice.h). In each interval, the number of quads
  ///                 is rounded, and is at least one.
  explicit QuadCounts(double density);

  /// Returns the number of quads from the midline of the face to lattice column k; negative if k <
  /// 0.
  int quads_to_column(int k) const;
  /// Returns the number of quads from the lower edge of the cap (lattice row 0) to lattice row k.
  int quads_to_row(int k) const;
  /// Returns the coordinate b (see LatticePoint) of every ring of an opening, without the opening's
  /// outline (b = 0).
  std::vector<double> ring_coordinates(SkinPatch patch) const;
  /// Returns the number of vertices of the whole layout.
  Index vertex_count() const;

  double quads_per_unit;  ///< parameter `density` of the constructor
  // Number of quads in each interval between two lattice columns (or rows).
  std::array<int, kColumns - 1> columns{};
  std::array<int, kRows - 1> rows{};
};

/// Returns the quad counts of the layout whose number of vertices is nearest to `wanted_vertices`.
QuadCounts nearest_counts(Index wanted_vertices);

}  // namespace crowdface::synth
