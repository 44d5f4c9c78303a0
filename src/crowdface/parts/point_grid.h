// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Some vertices of a mesh in a grid of cells, to be asked for the one nearest to a place.
class PointGrid {
 public:
  /// \param vertices  rows of `positions`, at least one; the positions must outlive the grid.
  PointGrid(const Positions& positions, std::span<const std::uint32_t> vertices);

  /// False if a point is farther than `reach` from all of them for certain.
  bool in_reach(const Eigen::Vector3d& point, double reach) const;

  struct Nearest {
    std::uint32_t vertex = kNoIndex;  ///< kNoIndex: none within the reach
    double distance = 0;
  };
  /// The nearest vertex within `reach` of a point; of equals the first.
  Nearest nearest(const Eigen::Vector3d& point, double reach = 1e300) const;

  /// All vertices that may lie within `reach` of a point, some of them farther off.
  std::vector<std::uint32_t> about(const Eigen::Vector3d& point, double reach) const;

 private:
  using Cell = std::array<Index, 3>;

  Cell cell_of(const Eigen::Vector3d& point) const;
  std::size_t number_of(const Cell& cell) const;
  /// The vertices of some cells in a row, first and last included.
  std::span<const std::uint32_t> between(std::size_t first, std::size_t last) const {
    return {by_cell_.of(first).data(), by_cell_.of(last).data() + by_cell_.of(last).size()};
  }

  const Positions& positions_;
  Eigen::Vector3d low_;
  double width_ = 1;                ///< of a cell
  Cell cells_ = {1, 1, 1};          ///< along x, y, z
  Grouped<std::uint32_t> by_cell_;  ///< vertices, ascending in each cell
};

}  // namespace crowdface
