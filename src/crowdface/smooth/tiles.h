// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Consecutive rows of a tile whose vertices have the same valence.
struct ValenceRun {
  std::uint32_t first_row = 0;        ///< local number of the run's first row
  std::uint32_t row_count = 0;        ///< number of rows in the run
  std::uint32_t valence = 0;          ///< number of neighbours of each vertex, at least 1
  std::uint32_t first_neighbour = 0;  ///< index of the first neighbour in `Tile::neighbours`
};

/// A part of the mesh. Several steps of the recurrence can run on a tile without data from other
/// tiles, so that the data stays in one core's cache. A tile consists of its own rows, which belong
/// to no other tile, and a halo: several rings of neighbours around its own rows. Local rows are
/// numbered in this order: the tile's own rows, ring 1 (the outside neighbours of own rows), ring
/// 2, … Each step invalidates the outermost valid ring, so with n rings the tile's own rows are
/// correct after n steps.
struct Tile {
  std::uint32_t first_row = 0;  ///< the tile's first own row, as an index into the tiling's order
  std::uint32_t row_count = 0;  ///< number of the tile's own rows, without the halo
  /// local row `row_count + i` is row `halo[i]` of the tiling's order
  std::vector<std::uint32_t> halo;
  /// runs of rows whose vertices are not fixed: first runs of own rows, then of ring 1, ring 2, …
  std::vector<ValenceRun> runs;
  /// The first run_count_up_to_ring[r] entries of `runs` cover the tile's own rows and the rings 1
  /// to r.
  std::vector<std::uint32_t> run_count_up_to_ring;
  /// neighbour lists (local rows), each in the operator's order
  std::vector<std::uint32_t> neighbours;

  /// Number of local rows: own rows and halo.
  std::uint32_t local_count() const { return row_count + static_cast<std::uint32_t>(halo.size()); }
};

/// A mesh cut into tiles. Rows are ordered tile by tile. The division into tiles affects the speed
/// of computations, not the results.
struct Tiling {
  std::vector<std::uint32_t> vertex_of_row;  ///< #V: for each row of the tiling's order, its vertex
  std::vector<std::uint32_t> row_of_vertex;  ///< #V: for each vertex, its row in the tiling's order
  std::vector<Tile> tiles;
  int ring_count = 0;  ///< number of neighbour rings in each tile's halo
};

/// All vertices ordered along a space-filling curve (Hilbert 1891), so that vertices that are
/// adjacent in the order are mostly close in space. Vertices in the same grid cell are ordered by
/// index.
std::vector<std::uint32_t> hilbert_order(const Positions& positions);

/// Cuts the mesh into tiles. Each tile gets a range of consecutive vertices in the order that
/// hilbert_order returns, so that the tile is a compact piece of the surface.
/// \param positions   #V by 3, any head of the topology.
/// \param tile_rows   largest number of vertices that a tile owns (its own rows).
/// \param ring_count  number of recurrence steps that a tile can run on its own.
Tiling cut_into_tiles(const SmoothingOperator& smoothing, const Positions& positions,
                      Index tile_rows, int ring_count);

}  // namespace crowdface
