// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/relief_fit.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdlib>

#include <Eigen/Cholesky>

namespace crowdface {
namespace {

constexpr double kMiddleMm = kReliefTopRowHeightMm - kReliefSpacingMm * (kReliefRows - 1) / 2;
// Mean of 16 synthetic heads: depth in mm relative to the tip of the nose, negative behind the tip.
// The first column is at the middle of the face, the last at the side.
constexpr std::array<std::array<double, kHalfReliefColumns>, kReliefRows> kMeanRelief = {{
    {-23, -24, -26, -29, -32, -36},
    {-21, -22, -25, -28, -32, -35},
    {-20, -21, -24, -28, -32, -34},
    {-20, -22, -28, -33, -33, -35},
    {-19, -22, -35, -33, -33, -35},
    {-15, -19, -31, -33, -33, -35},
    {-9, -14, -28, -30, -32, -34},
    {-3, -8, -23, -28, -29, -31},
    {0, -5, -18, -27, -28, -30},
    {-1, -4, -12, -27, -28, -31},
    {-14, -21, -26, -28, -29, -32},
    {-22, -22, -24, -28, -31, -34},
    {-16, -18, -22, -27, -32, -36},
    {-16, -18, -22, -27, -33, -38},
    {-18, -20, -24, -29, -34, -40},
    {-21, -22, -25, -30, -36, -43},
    {-21, -22, -25, -30, -37, -47},
}};

constexpr int kTerms = 6;  // terms of a fit: 1, x, y, x², y², relief
using Coefficients = Eigen::Matrix<double, kTerms, 1>;
using Products = Eigen::Matrix<double, kTerms, kTerms>;

constexpr double kUnitMm = 40;  // unit of x and y in the terms, in mm

/// The values of the fit's terms in each cell, and the sum over all cells of the outer products of
/// these values.
struct Terms {
  std::array<Coefficients, kReliefCells> of_cell;
  Products products = Products::Zero();

  Terms() {
    for (int c = 0; c < kReliefCells; ++c) {
      const double x = cell_lateral_offset_mm(c) / kUnitMm,
                   y = (cell_height_mm(c) - kMiddleMm) / kUnitMm;
      Coefficients& terms = of_cell[static_cast<std::size_t>(c)];
      terms = Coefficients(1, x, y, x * x, y * y, depth_of_mean_face_mm(c));
      products += terms * terms.transpose();
    }
  }
};
const Terms& terms() {
  static const Terms all;
  return all;
}

using UsedCells = std::bitset<kReliefCells>;

/// A least-squares fit of the model (see ReliefFit) to the depths in those cells of the grid that
/// contain a surface. The mean face is the last term of the model. The terms together explain a
/// part of the sum of the squared depths: the squared norm of the vector `explained`. The square of
/// its last entry is the part that the mean face explains in addition to all other terms.
struct CellFit {
  ReliefFit fit;
  Products factor = Products::Zero();  ///< Cholesky factor of the normal matrix, lower triangle
  Coefficients explained = Coefficients::Zero();  ///< L⁻¹ · (terms · depths); L is `factor`

  CellFit(const ReliefDepths& depths, const UsedCells& used) {
    constexpr double kMin = 0.72 * kReliefCells, kFlatMm = 0.05;
    const auto& of_cell = terms().of_cell;
    const auto count = static_cast<double>(used.count());
    if (count < kMin) return;
    Products products = terms().products;
    Coefficients by_depth = Coefficients::Zero();
    double squares = 0;
    for (std::size_t c = 0; c < kReliefCells; ++c) {
      if (used[c]) {
        by_depth += depths[c] * of_cell[c];
        squares += depths[c] * depths[c];
      } else {
        products -= of_cell[c] * of_cell[c].transpose();
      }
    }
    const Eigen::LLT<Products> cholesky(products);
    factor = cholesky.matrixLLT();
    explained = cholesky.matrixL().solve(by_depth);
    const double by_relief = explained(kTerms - 1);
    const double without_relief = squares - explained.head<kTerms - 1>().squaredNorm();
    const bool is_flat = !(without_relief > kFlatMm * kFlatMm * count);
    if (cholesky.info() != Eigen::Success || is_flat) return;
    fit.correlation = by_relief / std::sqrt(without_relief);
    fit.amplitude = by_relief / factor(kTerms - 1, kTerms - 1);
  }

  Coefficients coefficients() const {
    return factor.triangularView<Eigen::Lower>().adjoint().solve(explained);
  }
};

}  // namespace

double depth_of_mean_face_mm(int cell) {
  const int column = std::abs(cell % kReliefColumns - (kHalfReliefColumns - 1));
  return kMeanRelief[static_cast<std::size_t>(cell / kReliefColumns)]
                    [static_cast<std::size_t>(column)];
}

ReliefFit fit_relief(ReliefDepths depths) {
  constexpr double kDeepestMm = 75, kHoleMm = 14, kPromising = 0.25;
  const double foremost = *std::ranges::max_element(depths);
  if (foremost == kNoDepth) return {};
  UsedCells used;
  for (std::size_t c = 0; c < kReliefCells; ++c) {
    depths[c] -= foremost;
    used[c] = depths[c] > -kDeepestMm;
  }
  CellFit of_cells(depths, used);
  // An open mouth and the openings of the eyes lie behind the fitted model. At most twice, exclude
  // the cells that lie more than kHoleMm behind the model, and fit again.
  for (int round = 0; round < 2 && of_cells.fit.correlation > kPromising; ++round) {
    const Coefficients by = of_cells.coefficients();
    const UsedCells before = used;
    for (std::size_t c = 0; c < kReliefCells; ++c) {
      if (depths[c] - by.dot(terms().of_cell[c]) <= -kHoleMm) used.reset(c);
    }
    if (used == before) break;
    of_cells = CellFit(depths, used);
  }
  ReliefFit fit = of_cells.fit;
  if (fit.correlation > kPromising) {
    const Coefficients by = of_cells.coefficients();
    const double eyes = -kMiddleMm / kUnitMm;
    fit.offset = by(0) + by(2) * eyes + by(4) * eyes * eyes + foremost;
    fit.slope_up = by(2) / kUnitMm;
  }
  return fit;
}

}  // namespace crowdface
