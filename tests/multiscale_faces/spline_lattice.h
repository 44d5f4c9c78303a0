// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/smooth/columns.h"

namespace crowdface::multiscale {

/// A uniform bicubic B-spline function over the unit square, with values of C components (Lee,
/// Wolberg and Shin 1997, "Scattered Data Interpolation with Multilevel B-Splines", IEEE TVCG
/// 3(3)).
class SplineLattice {
 public:
  /// \param spans    number of polynomial pieces along each side, 1 or more.
  /// \param control  (spans + 3)² by C; the control point φ_ij of the paper (−1 ≤ i, j ≤ spans + 1)
  ///                 is row (i + 1) + (j + 1)·(spans + 3).
  SplineLattice(Index spans, Columns control);
  /// The function that is zero everywhere.
  static SplineLattice zero(Index spans, Index components);

  Index spans() const { return spans_; }
  Index components() const { return control_points_.cols(); }
  const Columns& control_points() const { return control_points_; }

  /// The value of the function at a point of the unit square.
  Eigen::RowVectorXd value(const Eigen::RowVector2d& uv) const;
  /// The value, and its derivatives along u and v, as rows.
  Eigen::Matrix<double, 3, Eigen::Dynamic> value_and_derivatives(
      const Eigen::RowVector2d& uv) const;

  /// The same function with twice as many spans (the paper's Section 4.2).
  SplineLattice refined() const;
  /// The sum of two functions with equally many spans.
  SplineLattice operator+(const SplineLattice& other) const;

 private:
  Index spans_;
  Columns control_points_;
};

/// The paper's BA algorithm. Each sample proposes values for the 16 control points around it: the
/// values that reproduce the sample and have the smallest sum of squares. Each control point
/// becomes the weighted mean of its proposals (Eqs. 3 to 5), or zero if there are no proposals.
/// \param uvs     #S by 2.
/// \param values  #S by C.
SplineLattice approximate(Index spans, const TextureCoordinates& uvs, const Columns& values);

/// The paper's MBA algorithm with refinement: the functions Ψ_0, Ψ_1, … Each function adds, on a
/// lattice with twice as many spans, an approximation of the errors of the previous function.
/// \param coarsest, finest  numbers of spans of the first and the last function; `finest` is
///                  `coarsest` times a power of two.
std::vector<SplineLattice> approximate_by_levels(Index coarsest, Index finest,
                                                 const TextureCoordinates& uvs,
                                                 const Columns& values);

}  // namespace crowdface::multiscale
