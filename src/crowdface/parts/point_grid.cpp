// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/point_grid.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace crowdface {
namespace {

constexpr double kMaxCells = 4e6;

}  // namespace

PointGrid::PointGrid(const Positions& positions, std::span<const std::uint32_t> vertices)
    : positions_(positions) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t vertex : vertices) box.extend(positions.row(vertex).transpose());
  min_corner_ = box.min();
  // The vertices lie on a surface, so about two of them fall into each cell that is not empty.
  const Eigen::Vector3d size = box.sizes();
  const double longest = std::max({size.x(), size.y(), size.z(), 1e-12});
  cell_width_ = longest / std::max(1.0, std::sqrt(static_cast<double>(vertices.size()) / 8));
  const auto count = [&](Index axis) { return std::floor(size(axis) / cell_width_) + 1; };
  while (count(0) * count(1) * count(2) > kMaxCells) cell_width_ *= 1.25;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell_counts_[axis] = static_cast<Index>(count(static_cast<Index>(axis)));
  }
  vertices_by_cell_ = compressed_rows<std::uint32_t>(
      static_cast<std::size_t>(cell_counts_[0] * cell_counts_[1] * cell_counts_[2]),
      [&](const auto& put) {
        for (const std::uint32_t vertex : vertices) {
          put(index_of(cell_of(positions.row(vertex).transpose())), vertex);
        }
      });
}

Index PointGrid::layer_at(double coordinate, Index axis) const {
  const Index last = cell_counts_[static_cast<std::size_t>(axis)] - 1;
  const double at = (coordinate - min_corner_(axis)) / cell_width_;
  return static_cast<Index>(std::clamp(at, 0.0, static_cast<double>(last)));
}

PointGrid::Cell PointGrid::cell_of(const Eigen::Vector3d& point) const {
  return {layer_at(point.x(), 0), layer_at(point.y(), 1), layer_at(point.z(), 2)};
}

std::size_t PointGrid::index_of(const Cell& cell) const {
  return static_cast<std::size_t>((cell[2] * cell_counts_[1] + cell[1]) * cell_counts_[0] +
                                  cell[0]);
}

bool PointGrid::may_have_vertex_within(const Eigen::Vector3d& point, double reach) const {
  double outside = 0;
  for (Index c = 0; c < 3; ++c) {
    const double high =
        min_corner_(c) +
        static_cast<double>(cell_counts_[static_cast<std::size_t>(c)]) * cell_width_;
    const double gap = std::max({min_corner_(c) - point(c), point(c) - high, 0.0});
    outside += gap * gap;
  }
  return std::sqrt(outside) <= reach + cell_width_;
}

PointGrid::NearestVertex PointGrid::nearest(const Eigen::Vector3d& point, double reach) const {
  NearestVertex best;
  best.distance = reach;
  if (!may_have_vertex_within(point, reach)) return best;
  const Cell middle = cell_of(point);
  // A lower bound of the distance from the point to a layer of cells; rounding cannot make this
  // bound too large.
  const auto gap_to = [&](Index axis, Index cell) {
    constexpr double kRounding = 1e-9;
    const double low = min_corner_(axis) + static_cast<double>(cell) * cell_width_;
    return std::max({low - point(axis), point(axis) - (low + cell_width_), 0.0}) -
           kRounding * cell_width_;
  };
  // Search row after row of cells, nearest rows first. `best.distance` then decreases soon, and
  // limits the rows, and the cells of a row, that remain to be searched.
  const auto search_row = [&](Index z, Index y) {
    const double width = best.distance + cell_width_;  // one cell more than rounding may need
    const Index low = layer_at(point.x() - width, 0), high = layer_at(point.x() + width, 0);
    for (const std::uint32_t v : vertices_in_cells(index_of({low, y, z}), index_of({high, y, z}))) {
      const double dx = positions_(v, 0) - point.x();
      const double dy = positions_(v, 1) - point.y();
      const double dz = positions_(v, 2) - point.z();
      const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
      if (distance < best.distance || (distance == best.distance && v < best.vertex)) {
        best = {v, distance};
      }
    }
  };
  // Calls `visit` for the layers of cells along an axis, from the point's layer outwards, while
  // they are in reach.
  const auto for_each_layer = [&](Index axis, const auto& visit) {
    const auto a = static_cast<std::size_t>(axis);
    const auto visit_if_near = [&](Index cell) {
      if (cell < 0 || cell >= cell_counts_[a] || gap_to(axis, cell) > best.distance) return false;
      visit(cell);
      return true;
    };
    visit_if_near(middle[a]);
    bool goes_down = true, goes_up = true;
    for (Index step = 1; goes_down || goes_up; ++step) {
      goes_down = goes_down && visit_if_near(middle[a] - step);
      goes_up = goes_up && visit_if_near(middle[a] + step);
    }
  };
  for_each_layer(2, [&](Index z) { for_each_layer(1, [&](Index y) { search_row(z, y); }); });
  return best;
}

std::vector<std::uint32_t> PointGrid::vertices_near(const Eigen::Vector3d& point,
                                                    double reach) const {
  std::vector<std::uint32_t> found;
  if (!may_have_vertex_within(point, reach)) return found;
  const Eigen::Vector3d all_sides = Eigen::Vector3d::Constant(reach);
  const Cell low = cell_of(point - all_sides), high = cell_of(point + all_sides);
  for (Index z = low[2]; z <= high[2]; ++z) {
    for (Index y = low[1]; y <= high[1]; ++y) {
      const auto row = vertices_in_cells(index_of({low[0], y, z}), index_of({high[0], y, z}));
      found.insert(found.end(), row.begin(), row.end());
    }
  }
  return found;
}

}  // namespace crowdface
