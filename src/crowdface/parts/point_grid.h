// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Some vertices of a mesh in a uniform grid, for nearest-vertex queries.
class PointGrid {
 public:
  /// \param vertices  rows of `positions`, at least one; the positions must outlive the grid.
  PointGrid(const Positions& positions, std::span<const std::uint32_t> vertices);

  /// A fast, conservative test: returns true if a vertex lies within `reach` of the point, and
  /// sometimes even if none does.
  bool may_have_vertex_within(const Eigen::Vector3d& point, double reach) const;

  struct NearestVertex {
    std::uint32_t vertex = kNoIndex;  ///< kNoIndex: no vertex is in reach
    double distance = 0;
  };
  /// The nearest vertex within `reach` of a point. Of several equally near vertices, the vertex
  /// with the lowest index.
  NearestVertex nearest(const Eigen::Vector3d& point, double reach = 1e300) const;

  /// All vertices within `reach` of a point, and possibly some vertices that are farther away.
  std::vector<std::uint32_t> vertices_near(const Eigen::Vector3d& point, double reach) const;

 private:
  using Cell = std::array<Index, 3>;  ///< number of a cell along x, y, z, from 0

  /// The layer of cells at a coordinate, or the nearest layer of the grid.
  /// \param axis  0, 1, 2 for layers along x, y, z
  Index layer_at(double coordinate, Index axis) const;
  /// Returns the cell that contains a point; for a point outside the grid, the nearest cell.
  Cell cell_of(const Eigen::Vector3d& point) const;
  /// Returns the index of a cell in `vertices_by_cell_`.
  std::size_t index_of(const Cell& cell) const;
  /// The vertices in the consecutive cells `first` to `last`, both included.
  std::span<const std::uint32_t> vertices_in_cells(std::size_t first, std::size_t last) const {
    return {vertices_by_cell_.items_of(first).data(),
            vertices_by_cell_.items_of(last).data() + vertices_by_cell_.items_of(last).size()};
  }

  const Positions& positions_;
  Eigen::Vector3d min_corner_;    ///< smallest coordinates of all vertices
  double cell_width_ = 1;         ///< edge length of a cell
  Cell cell_counts_ = {1, 1, 1};  ///< number of cells along x, y, z
  /// for each cell: the vertices in it, ascending
  CompressedRows<std::uint32_t> vertices_by_cell_;
};

}  // namespace crowdface
