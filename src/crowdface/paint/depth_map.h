// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/topology.h"
#include "crowdface/paint/relief_fit.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// The foremost depth of a surface in each square of a grid, seen from the front.
class DepthMap {
 public:
  /// \param square  how large a square is
  DepthMap(const Positions& samples, const HeadAxes& axes, double square);

  /// Means over three by three squares, of those that show the surface: noise counts less.
  void soften();

  const Eigen::AlignedBox2d& box() const { return box_; }

  /// How the surface compares with the mean face.
  /// \param across, height  between the eyes. \param scale, stretch  see ReliefMatch
  ReliefFit fit(double across, double height, double scale, double stretch = 1) const;

 private:
  /// A place along one side of the grid: the square that holds the place, the one whose middle lies below, and the share
  /// of the next one. No square: -1.
  struct Lookup {
    Index nearest = -1, below = -1;
    double share = 0;
  };
  Lookup look_up(double offset, double extent, Index count) const;
  /// Linear between the middles of four squares if all of them show the surface.
  double at(const Lookup& column, const Lookup& row) const;
  std::size_t index(double x, double y) const;

  Eigen::AlignedBox2d box_;
  double square_;
  Index columns_ = 0, rows_ = 0;
  std::vector<double> depths_;
};

}  // namespace crowdface
