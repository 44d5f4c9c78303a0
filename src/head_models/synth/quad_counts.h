// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// Whole numbers of quads in every lattice interval and ring span: what makes a layout of one size.
struct QuadCounts {
  /// \param scale_in  quads a unit, rounded in each interval; at least one.
  explicit QuadCounts(double scale_in);

  /// Quads from the midline to lattice column k, negative to the other side; from the cap to row k.
  int column(int k) const;
  int row(int k) const;
  /// b of every ring of a window after the rectangle itself.
  std::vector<double> rings(Sheet sheet) const;
  /// Vertices of the whole layout.
  Index vertices() const;

  double scale;
  std::array<int, kColumns - 1> columns{};
  std::array<int, kRows - 1> rows{};
};

/// The counts whose number of vertices is nearest to the wanted one.
QuadCounts nearest_counts(Index wanted);

}  // namespace crowdface::synth
