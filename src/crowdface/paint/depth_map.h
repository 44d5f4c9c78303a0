// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/topology.h"
#include "crowdface/paint/relief_fit.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Depth map of a surface seen from the front: the depth (front coordinate) of the foremost point
/// in each square cell of a grid.
class DepthMap {
 public:
  /// \param samples      #S by 3: points of the surface
  /// \param cell_size  edge length of a cell, in the unit of the samples
  DepthMap(const Positions& samples, const HeadAxes& axes, double cell_size);

  /// Reduces noise: replaces the depth of each cell by the mean of the known depths in the three by
  /// three cells around this cell. Also fills empty cells next to the surface. The outermost cells
  /// of the grid do not change.
  void smooth();

  /// Bounding rectangle of the samples, in coordinates along axes.side() and along axes.up.
  const Eigen::AlignedBox2d& box() const { return box_; }

  /// Places the mean face on the surface and compares their depths.
  /// \param lateral_position, height  where to place the point between the eyes of the mean face
  /// \param scale, stretch  size of the mean face, see ReliefMatch
  ReliefFit fit(double lateral_position, double height, double scale, double stretch = 1) const;

  /// Returns the depth of the surface at a point; kNoDepth where the map shows no surface.
  double depth(double lateral_position, double height) const;

 private:
  /// Indices, along one axis of the grid, of the cells around a coordinate.
  struct AxisCells {
    Index containing_cell = -1;  ///< the cell that contains the coordinate; −1: none
    /// largest index of a cell whose centre is below the coordinate; −1: none
    Index previous_cell = -1;
    /// Interpolation weight of the cell after `previous_cell`. The weight of `previous_cell` is 1
    /// minus this weight.
    double next_cell_weight = 0;
  };
  /// \param offset  distance of the coordinate from the start of the axis
  /// \param extent  length of the grid along the axis
  /// \param count   number of cells along the axis
  AxisCells cells_at(double offset, double extent, Index count) const;
  /// Depth at a point of the grid: interpolated bilinearly between the centres of the four nearest
  /// cells if all four show the surface, otherwise the depth of the cell that contains the point.
  /// kNoDepth outside the grid.
  double depth_in_cells(const AxisCells& column, const AxisCells& row) const;
  /// Returns the index in `depths_` of the cell that contains a point. `x` is the point's
  /// coordinate along axes.side(), and `y` its coordinate along axes.up.
  std::size_t cell_index(double x, double y) const;

  Eigen::AlignedBox2d box_;
  double cell_size_;
  Index columns_ = 0, rows_ = 0;  ///< numbers of columns and of rows of cells
  std::vector<double> depths_;    ///< depth of each cell, row by row; kNoDepth: no surface
};

}  // namespace crowdface
