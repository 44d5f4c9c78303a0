// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Rows of a tile that have the same valence and stand one after the other.
struct ValenceRun {
  std::uint32_t first = 0;    ///< local row
  std::uint32_t count = 0;    ///< rows
  std::uint32_t valence = 0;  ///< neighbours of each, at least 1
  std::uint32_t ring = 0;     ///< where their neighbours begin in `Tile::rings`
};

/// A patch of the mesh that several steps of a recurrence can be computed on without looking
/// outside, and so in the processor's cache: its own rows and the rings around them. Local rows are
/// the own ones first, then ring 1 (their neighbours outside), ring 2, … After a step the outermost
/// ring is out of date, so that with n rings n steps are right on the own rows.
struct Tile {
  std::uint32_t first = 0;          ///< the first of its own rows in the tiling's order
  std::uint32_t count = 0;          ///< own rows
  std::vector<std::uint32_t> halo;  ///< rows (tiling's order) of local rows count, count + 1, …
  std::vector<ValenceRun> runs;     ///< of the rows that move: own, ring 1, ring 2, …
  std::vector<std::uint32_t> runs_to;  ///< runs_to[r]: how many runs cover the rings up to r
  std::vector<std::uint32_t> rings;    ///< neighbours (local rows), in the operator's order

  std::uint32_t local_count() const { return count + static_cast<std::uint32_t>(halo.size()); }
};

/// A mesh cut into tiles. Its order of rows runs tile by tile; what is computed on it does not
/// depend on the cut, only how fast.
struct Tiling {
  std::vector<std::uint32_t> order;  ///< #V: the vertex that stands in a row
  std::vector<std::uint32_t> row;    ///< #V: the row a vertex stands in
  std::vector<Tile> tiles;
  int ring_count = 0;
};

/// All vertices along a space-filling curve through the head (Hilbert 1891), so that neighbours in the order are mostly
/// neighbours in space; equal places by index.
std::vector<std::uint32_t> hilbert_order(const Positions& positions);

/// Cuts by halving the longest side of the vertices' box again and again, which makes compact
/// patches of a surface.
/// \param positions   #V by 3, any head of the topology.
/// \param tile_rows   the most own rows of a tile.
/// \param ring_count  steps that a tile can do on its own.
Tiling cut_into_tiles(const SmoothingOperator& smoothing, const Positions& positions,
                      Index tile_rows, int ring_count);

}  // namespace crowdface
