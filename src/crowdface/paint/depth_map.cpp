// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/depth_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/mesh/vector3.h"

namespace crowdface {

DepthMap::DepthMap(const Positions& samples, const HeadAxes& axes, double cell_size)
    : cell_size_(cell_size) {
  if (samples.rows() == 0) return;  // no surface anywhere
  const Eigen::Vector3d side = axes.side();
  Positions seen(samples.rows(), 3);
  for (Index i = 0; i < samples.rows(); ++i) {
    const Eigen::Vector3d p = row3(samples, i);
    seen.row(i) << p.dot(side), p.dot(axes.up), p.dot(axes.front);
    box_.extend(Eigen::Vector2d(seen(i, 0), seen(i, 1)));
  }
  columns_ = static_cast<Index>(box_.sizes().x() / cell_size_) + 1;
  rows_ = static_cast<Index>(box_.sizes().y() / cell_size_) + 1;
  depths_.assign(static_cast<std::size_t>(columns_ * rows_), kNoDepth);
  for (Index i = 0; i < seen.rows(); ++i) {
    double& depth = depths_[cell_index(seen(i, 0), seen(i, 1))];
    depth = std::max(depth, seen(i, 2));
  }
}

void DepthMap::smooth() {
  const std::vector<double> before = depths_;
  for (Index row = 1; row + 1 < rows_; ++row) {
    for (Index column = 1; column + 1 < columns_; ++column) {
      double sum = 0;
      int count = 0;
      for (const Index beside : {-columns_ - 1, -columns_, -columns_ + 1, Index{-1}, Index{0},
                                 Index{1}, columns_ - 1, columns_, columns_ + 1}) {
        const double depth = before[static_cast<std::size_t>(row * columns_ + column + beside)];
        if (depth == kNoDepth) continue;
        sum += depth;
        ++count;
      }
      if (count > 0) depths_[static_cast<std::size_t>(row * columns_ + column)] = sum / count;
    }
  }
}

DepthMap::AxisCells DepthMap::cells_at(double offset, double extent, Index count) const {
  AxisCells cells;
  if (!(offset >= 0 && offset <= extent)) return cells;
  const double place = offset / cell_size_;
  cells.containing_cell = std::min(static_cast<Index>(place), count - 1);
  if (place < 0.5) return cells;
  const auto below = static_cast<Index>(place - 0.5);
  if (below + 1 >= count) return cells;
  cells.previous_cell = below;
  cells.next_cell_weight = place - 0.5 - static_cast<double>(below);
  return cells;
}

ReliefFit DepthMap::fit(double lateral_position, double height, double scale,
                        double stretch) const {
  const Eigen::Vector2d extent = box_.sizes();
  std::array<AxisCells, kReliefColumns> columns;
  std::array<AxisCells, kReliefRows> rows;
  for (int c = 0; c < kReliefColumns; ++c) {
    const double x = lateral_position + scale * cell_lateral_offset_mm(c);
    columns[static_cast<std::size_t>(c)] = cells_at(x - box_.min().x(), extent.x(), columns_);
  }
  for (int r = 0; r < kReliefRows; ++r) {
    const double y = height + stretch * scale * cell_height_mm(r * kReliefColumns);
    rows[static_cast<std::size_t>(r)] = cells_at(y - box_.min().y(), extent.y(), rows_);
  }
  ReliefDepths depths;
  auto depth = depths.begin();
  for (const AxisCells& row : rows) {
    for (const AxisCells& column : columns) *depth++ = depth_in_cells(column, row) / scale;
  }
  return fit_relief(depths);
}

double DepthMap::depth(double lateral_position, double height) const {
  const Eigen::Vector2d extent = box_.sizes();
  return depth_in_cells(cells_at(lateral_position - box_.min().x(), extent.x(), columns_),
                        cells_at(height - box_.min().y(), extent.y(), rows_));
}

double DepthMap::depth_in_cells(const AxisCells& column, const AxisCells& row) const {
  if (column.containing_cell < 0 || row.containing_cell < 0) return kNoDepth;
  if (column.previous_cell >= 0 && row.previous_cell >= 0) {
    const double* corner =
        &depths_[static_cast<std::size_t>(row.previous_cell * columns_ + column.previous_cell)];
    const double s = column.next_cell_weight, t = row.next_cell_weight;
    const double depth = (1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
                         t * ((1 - s) * corner[columns_] + s * corner[columns_ + 1]);
    if (std::isfinite(depth)) return depth;
  }
  return depths_[static_cast<std::size_t>(row.containing_cell * columns_ + column.containing_cell)];
}

std::size_t DepthMap::cell_index(double x, double y) const {
  const auto column = std::min(static_cast<Index>((x - box_.min().x()) / cell_size_), columns_ - 1);
  const auto row = std::min(static_cast<Index>((y - box_.min().y()) / cell_size_), rows_ - 1);
  return static_cast<std::size_t>(row * columns_ + column);
}

}  // namespace crowdface
