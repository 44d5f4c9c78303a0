// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/spline_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface::multiscale {
namespace {

/// The four cubic B-spline basis functions at t in [0, 1], and their derivatives.
struct Basis {
  std::array<double, 4> value, slope;
};
Basis basis_at(double t) {
  const double s = 1 - t;
  return {{s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
           (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6},
          {-s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * t * t + 2 * t + 1) / 2, t * t / 2}};
}

/// The 4 by 4 control points that influence a point (u, v), and the values of the basis functions
/// along u and v.
struct SplineSupport {
  Index first_row;  ///< row of the first of the 16 control points
  Basis u, v;
};
SplineSupport place_of(Index spans, const Eigen::RowVector2d& uv) {
  const auto split = [&](double x) {
    const double scaled = std::clamp(x, 0.0, 1.0) * static_cast<double>(spans);
    const Index span = std::min(static_cast<Index>(scaled), spans - 1);
    return std::pair(span, scaled - static_cast<double>(span));
  };
  const auto [i, s] = split(uv[0]);
  const auto [j, t] = split(uv[1]);
  return {i + j * (spans + 3), basis_at(s), basis_at(t)};
}

}  // namespace

SplineLattice::SplineLattice(Index spans, Columns control)
    : spans_(spans), control_points_(std::move(control)) {
  require(spans >= 1 && control_points_.rows() == (spans + 3) * (spans + 3),
          "a lattice needs (spans + 3)² control points");
}

SplineLattice SplineLattice::zero(Index spans, Index components) {
  return {spans, Columns::Zero((spans + 3) * (spans + 3), components)};
}

Eigen::RowVectorXd SplineLattice::value(const Eigen::RowVector2d& uv) const {
  const SplineSupport place = place_of(spans_, uv);
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(components());
  for (Index l = 0; l < 4; ++l) {
    for (Index k = 0; k < 4; ++k) {
      sum += place.u.value[static_cast<std::size_t>(k)] *
             place.v.value[static_cast<std::size_t>(l)] *
             control_points_.row(place.first_row + k + l * (spans_ + 3));
    }
  }
  return sum;
}

Eigen::Matrix<double, 3, Eigen::Dynamic> SplineLattice::value_and_derivatives(
    const Eigen::RowVector2d& uv) const {
  const SplineSupport place = place_of(spans_, uv);
  const auto scale = static_cast<double>(spans_);
  Eigen::Matrix<double, 3, Eigen::Dynamic> value_and_derivatives(3, components());
  value_and_derivatives.setZero();
  for (std::size_t l = 0; l < 4; ++l) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto point = control_points_.row(place.first_row + static_cast<Index>(k) +
                                             static_cast<Index>(l) * (spans_ + 3));
      value_and_derivatives.row(0) += place.u.value[k] * place.v.value[l] * point;
      value_and_derivatives.row(1) += scale * place.u.slope[k] * place.v.value[l] * point;
      value_and_derivatives.row(2) += scale * place.u.value[k] * place.v.slope[l] * point;
    }
  }
  return value_and_derivatives;
}

SplineLattice SplineLattice::refined() const {
  const Index side = spans_ + 3, fine = 2 * spans_ + 3;
  // Refines the control points φ_i along one direction. The new control points are
  // φ'_2i = (φ_i−1 + 6 φ_i + φ_i+1)/8 and φ'_2i+1 = (φ_i + φ_i+1)/2.
  // In both lattices, row i + 1 contains the control point with index i.
  const auto combine = [](Index row, const auto& at) -> Eigen::RowVectorXd {
    const Index i = (row - 1 >= 0 ? (row - 1) / 2 : -1) + 1;  // row of φ_i in the coarse lattice
    if ((row - 1) % 2 == 0) return (at(i - 1) + 6 * at(i) + at(i + 1)) / 8;
    return (at(i) + at(i + 1)) / 2;
  };
  Columns half(fine * side, components());  // refined along u
  for (Index j = 0; j < side; ++j) {
    for (Index i = 0; i < fine; ++i) {
      half.row(i + j * fine) =
          combine(i, [&](Index k) { return control_points_.row(k + j * side); });
    }
  }
  Columns control(fine * fine, components());
  for (Index j = 0; j < fine; ++j) {
    for (Index i = 0; i < fine; ++i) {
      control.row(i + j * fine) = combine(j, [&](Index k) { return half.row(i + k * fine); });
    }
  }
  return {2 * spans_, std::move(control)};
}

SplineLattice SplineLattice::operator+(const SplineLattice& other) const {
  require(spans_ == other.spans_, "lattices of different sizes cannot be added");
  return {spans_, control_points_ + other.control_points_};
}

SplineLattice approximate(Index spans, const TextureCoordinates& uvs, const Columns& values) {
  require(uvs.rows() == values.rows(), "each sample needs a place and a value");
  SplineLattice zero = SplineLattice::zero(spans, values.cols());
  Columns control = zero.control_points();
  Eigen::VectorXd weight_sum = Eigen::VectorXd::Zero(control.rows());
  for (Index s = 0; s < uvs.rows(); ++s) {
    const SplineSupport place = place_of(spans, uvs.row(s));
    double square_sum = 0;
    for (const double a : place.u.value) {
      for (const double b : place.v.value) square_sum += a * a * b * b;
    }
    for (std::size_t l = 0; l < 4; ++l) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double w = place.u.value[k] * place.v.value[l];
        const Index row =
            place.first_row + static_cast<Index>(k) + static_cast<Index>(l) * (spans + 3);
        control.row(row) += w * w * (w / square_sum) * values.row(s);  // Eq. 3, where ω_c is w
        weight_sum[row] += w * w;
      }
    }
  }
  for (Index row = 0; row < control.rows(); ++row) {
    if (weight_sum[row] > 0) control.row(row) /= weight_sum[row];  // Eq. 5
  }
  return {spans, std::move(control)};
}

std::vector<SplineLattice> approximate_by_levels(Index coarsest, Index finest,
                                                 const TextureCoordinates& uvs,
                                                 const Columns& values) {
  std::vector<SplineLattice> levels = {approximate(coarsest, uvs, values)};
  while (levels.back().spans() < finest) {
    Columns errors = values;
    parallel_for_each(uvs.rows(), kRowsPerTask,
                      [&](Index s) { errors.row(s) -= levels.back().value(uvs.row(s)); });
    SplineLattice refined = levels.back().refined();
    levels.push_back(refined + approximate(refined.spans(), uvs, errors));
  }
  return levels;
}

}  // namespace crowdface::multiscale
