// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/topology.h"
#include "crowdface/paint/relief_fit.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Depth map of a surface seen from the front: the depth of the foremost point in each square of a
/// grid.
class DepthMap {
 public:
  /// \param square_size  edge length of a square
  DepthMap(const Positions& samples, const HeadAxes& axes, double square_size);

  /// Reduces noise: replaces each depth by the mean of the known depths in the three by three
  /// squares around it. Also fills empty squares next to the surface. The outermost squares of the
  /// grid do not change.
  void smooth();

  const Eigen::AlignedBox2d& box() const { return box_; }

  /// Compares the depths of the surface with the depths of the mean face. The arguments place and
  /// scale the mean face.
  /// \param lateral_position, height  coordinates of the point between the eyes.
  /// \param scale, stretch  see ReliefMatch
  ReliefFit fit(double lateral_position, double height, double scale, double stretch = 1) const;

  /// Depth at a point; kNoDepth where the map shows no surface.
  double depth(double lateral_position, double height) const;

 private:
  /// Indices, along one axis of the grid, of the cells around a coordinate.
  struct AxisCells {
    Index containing_cell = -1;  ///< the cell that contains the coordinate; −1: none
    /// largest index of a cell whose centre is below the coordinate; −1: none
    Index cell_centred_below = -1;
    double next_cell_weight = 0;  ///< interpolation weight of cell `cell_centred_below` + 1
  };
  AxisCells cells_at(double offset, double extent, Index count) const;
  /// Depth at a point of the grid: interpolated bilinearly between the centres of the four nearest
  /// cells if all four show the surface, otherwise the depth of the cell that contains the point.
  /// kNoDepth outside the grid.
  double depth_in_cells(const AxisCells& column, const AxisCells& row) const;
  std::size_t cell_index(double x, double y) const;

  Eigen::AlignedBox2d box_;
  double cell_size_;
  Index columns_ = 0, rows_ = 0;
  std::vector<double> depths_;
};

}  // namespace crowdface
