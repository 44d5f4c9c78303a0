// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/tiles.h"

#include <algorithm>
#include <array>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// The index of a grid cell along the Hilbert curve. The grid has 2²¹ cells per axis. Cells that
/// are close along the curve are also close in space. Source: Skilling 2004, "Programming the
/// Hilbert curve".
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> cell) {
  constexpr int kBits = 21;
  for (std::uint32_t bit = 1U << (kBits - 1); bit > 1; bit >>= 1) {  // undo excess work
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : cell) {
      if ((axis & bit) != 0) {
        cell[0] ^= below;
      } else {
        const std::uint32_t swapped = (cell[0] ^ axis) & below;
        cell[0] ^= swapped;
        axis ^= swapped;
      }
    }
  }
  cell[1] ^= cell[0];  // Gray code
  cell[2] ^= cell[1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = 1U << (kBits - 1); bit > 1; bit >>= 1) {
    if ((cell[2] & bit) != 0) flip ^= bit - 1;
  }
  std::uint64_t index = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    for (const std::uint32_t axis : cell) index = index << 1 | (((axis ^ flip) >> bit) & 1U);
  }
  return index;
}

/// Orders a tile's own vertices breadth first (Cuthill & McKee 1969), then sorts them by valence
/// with a stable sort. The filter stores the vertices in this order, one row for each vertex. With
/// this order, the mesh neighbours of vertices in consecutive rows lie in few short ranges of rows.
void order_within(const Tile& tile, const SmoothingOperator& smoothing,
                  const std::vector<std::uint32_t>& tile_of, std::uint32_t tile_index,
                  std::vector<bool>& seen, std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> queue;
  queue.reserve(tile.row_count);
  std::size_t head = 0;
  for (std::uint32_t r = tile.first_row; r < tile.first_row + tile.row_count; ++r) {
    const auto enqueue = [&](std::uint32_t v) {
      if (seen[v] || tile_of[v] != tile_index) return;
      seen[v] = true;
      queue.push_back(v);
    };
    enqueue(order[r]);
    for (; head < queue.size(); ++head) {
      for (const std::uint32_t n : smoothing.neighbours(queue[head])) enqueue(n);
    }
  }
  std::ranges::stable_sort(queue, [&](std::uint32_t a, std::uint32_t b) {
    return smoothing.neighbours(a).size() < smoothing.neighbours(b).size();
  });
  std::ranges::copy(queue, order.begin() + tile.first_row);
}

/// Collects the halo of a tile ring by ring, and writes the tile's neighbour lists as local row
/// numbers.
class TileBuilder {
 public:
  TileBuilder(const SmoothingOperator& smoothing, Tiling& tiling)
      : smoothing_(smoothing),
        tiling_(tiling),
        local_row_of_vertex_(tiling.vertex_of_row.size(), kNowhere) {}

  void build(Tile& tile) {
    vertices_.assign(tiling_.vertex_of_row.begin() + tile.first_row,
                     tiling_.vertex_of_row.begin() + tile.first_row + tile.row_count);
    number(0);
    std::size_t begin = 0;
    for (int ring = 0; ring < tiling_.ring_count; ++ring) {
      const std::size_t end = vertices_.size();
      collect_neighbours(begin, end);
      sort_by_valence(end, vertices_.size());
      number(end);
      add_runs(tile, begin, end);
      tile.run_count_up_to_ring.push_back(static_cast<std::uint32_t>(tile.runs.size()));
      begin = end;
    }
    for (std::size_t l = tile.row_count; l < vertices_.size(); ++l) {
      tile.halo.push_back(tiling_.row_of_vertex[vertices_[l]]);
    }
    for (const std::uint32_t v : vertices_) local_row_of_vertex_[v] = kNowhere;
  }

 private:
  static constexpr std::uint32_t kNowhere = kNoIndex;
  static constexpr std::uint32_t kFound = 0xfffffffeU;

  std::size_t valence(std::uint32_t vertex) const { return smoothing_.neighbours(vertex).size(); }

  void collect_neighbours(std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      for (const std::uint32_t n : smoothing_.neighbours(vertices_[l])) {
        if (local_row_of_vertex_[n] != kNowhere) continue;
        local_row_of_vertex_[n] = kFound;
        vertices_.push_back(n);
      }
    }
  }

  void sort_by_valence(std::size_t begin, std::size_t end) {
    std::stable_sort(vertices_.begin() + static_cast<std::ptrdiff_t>(begin),
                     vertices_.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t a, std::uint32_t b) { return valence(a) < valence(b); });
  }

  void number(std::size_t begin) {
    for (std::size_t l = begin; l < vertices_.size(); ++l) {
      local_row_of_vertex_[vertices_[l]] = static_cast<std::uint32_t>(l);
    }
  }

  void add_runs(Tile& tile, std::size_t begin, std::size_t end) const {
    for (std::size_t l = begin; l < end; ++l) {
      const auto ring = smoothing_.neighbours(vertices_[l]);
      if (ring.empty()) continue;
      const auto size = static_cast<std::uint32_t>(ring.size());
      if (l == begin || tile.runs.empty() || tile.runs.back().valence != size ||
          tile.runs.back().first_row + tile.runs.back().row_count != l) {
        tile.runs.push_back({static_cast<std::uint32_t>(l), 0, size,
                             static_cast<std::uint32_t>(tile.neighbours.size())});
      }
      ++tile.runs.back().row_count;
      for (const std::uint32_t n : ring) tile.neighbours.push_back(local_row_of_vertex_[n]);
    }
  }

  const SmoothingOperator& smoothing_;
  Tiling& tiling_;
  /// each vertex's local row in the current tile
  std::vector<std::uint32_t> local_row_of_vertex_;
  /// the vertex of each local row of the current tile
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

std::vector<std::uint32_t> hilbert_order(const Positions& positions) {
  const Eigen::RowVector3d low = positions.colwise().minCoeff();
  const double extent = (positions.colwise().maxCoeff() - low).maxCoeff();
  const double scale = extent > 0 ? 2097151.0 / extent : 0;  // 2²¹ − 1
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(
      static_cast<std::size_t>(positions.rows()));
  constexpr Index kBlock = 1 << 16;
  parallel_for_each(positions.rows(), kBlock, [&](Index i) {
    std::array<std::uint32_t, 3> cell{};
    for (Index c = 0; c < 3; ++c) {
      cell[static_cast<std::size_t>(c)] =
          static_cast<std::uint32_t>((positions(i, c) - low(c)) * scale);
    }
    places[static_cast<std::size_t>(i)] = {hilbert_index(cell), static_cast<std::uint32_t>(i)};
  });
  std::ranges::sort(places);
  std::vector<std::uint32_t> order(places.size());
  std::transform(places.begin(), places.end(), order.begin(),
                 [](const auto& p) { return p.second; });
  return order;
}

Tiling cut_into_tiles(const SmoothingOperator& smoothing, const Positions& positions,
                      Index tile_rows, int ring_count) {
  const Index vertices = smoothing.vertex_count();
  require(positions.rows() == vertices, "tiles: ", positions.rows(), " positions, ", vertices,
          " vertices");
  Tiling tiling;
  tiling.ring_count = ring_count;
  if (vertices == 0) return tiling;
  tiling.vertex_of_row = hilbert_order(positions);
  const Index tile_count = (vertices + tile_rows - 1) / tile_rows;
  for (Index t = 0; t < tile_count; ++t) {
    Tile tile;
    tile.first_row = static_cast<std::uint32_t>(vertices * t / tile_count);
    tile.row_count = static_cast<std::uint32_t>(vertices * (t + 1) / tile_count) - tile.first_row;
    tiling.tiles.push_back(std::move(tile));
  }
  std::vector<std::uint32_t> tile_of(tiling.vertex_of_row.size());
  for (std::size_t t = 0; t < tiling.tiles.size(); ++t) {
    const Tile& tile = tiling.tiles[t];
    for (std::uint32_t r = tile.first_row; r < tile.first_row + tile.row_count; ++r) {
      tile_of[tiling.vertex_of_row[r]] = static_cast<std::uint32_t>(t);
    }
  }
  std::vector<bool> seen(tiling.vertex_of_row.size());
  for (std::size_t t = 0; t < tiling.tiles.size(); ++t) {
    order_within(tiling.tiles[t], smoothing, tile_of, static_cast<std::uint32_t>(t), seen,
                 tiling.vertex_of_row);
  }
  tiling.row_of_vertex.resize(tiling.vertex_of_row.size());
  for (std::size_t r = 0; r < tiling.vertex_of_row.size(); ++r) {
    tiling.row_of_vertex[tiling.vertex_of_row[r]] = static_cast<std::uint32_t>(r);
  }
  constexpr Index kTilesPerTask = 32;  // large tasks, because each allocates an array of #V
  parallel_blocks(tile_count, kTilesPerTask, [&](Index begin, Index end) {
    TileBuilder builder(smoothing, tiling);
    for (Index t = begin; t < end; ++t) builder.build(tiling.tiles[static_cast<std::size_t>(t)]);
  });
  return tiling;
}

}  // namespace crowdface
