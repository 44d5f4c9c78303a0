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

  /// A fast, conservative test whether a vertex may lie within `reach` of the point: false only if
  /// no vertex does; true proves nothing.
  bool may_be_in_reach(const Eigen::Vector3d& point, double reach) const;

  struct Nearest {
    std::uint32_t vertex = kNoIndex;  ///< kNoIndex: no vertex is in reach
    double distance = 0;
  };
  /// The nearest vertex within `reach` of a point. If several vertices are equally near, the one
  /// with the lowest index.
  Nearest nearest(const Eigen::Vector3d& point, double reach = 1e300) const;

  /// All vertices within `reach` of a point, and possibly some vertices that are farther away.
  std::vector<std::uint32_t> vertices_near(const Eigen::Vector3d& point, double reach) const;

 private:
  using Cell = std::array<Index, 3>;

  Cell cell_of(const Eigen::Vector3d& point) const;
  std::size_t number_of(const Cell& cell) const;
  /// The vertices in the consecutive cells `first` to `last`, both included.
  std::span<const std::uint32_t> vertices_in_cells(std::size_t first, std::size_t last) const {
    return {by_cell_.of(first).data(), by_cell_.of(last).data() + by_cell_.of(last).size()};
  }

  const Positions& positions_;
  Eigen::Vector3d low_;
  double width_ = 1;                       ///< edge length of a cell
  Cell cells_ = {1, 1, 1};                 ///< number of cells along x, y, z
  CompressedRows<std::uint32_t> by_cell_;  ///< vertices, ascending within each cell
};

}  // namespace crowdface
