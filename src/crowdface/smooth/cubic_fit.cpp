// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/cubic_fit.h"

#include <vector>

#include <Eigen/QR>

#include "crowdface/smooth/level_size.h"

namespace crowdface {

std::array<double, CubicFit::kRank> cubic_basis(std::uint64_t level, std::uint64_t max_level) {
  const double t = static_cast<double>(level) / static_cast<double>(max_level);
  return {1, t, t * t, t * t * t};
}

CubicFit fit_cubic(const ChebyshevFilter& filter, const Positions& positions,
                   std::uint64_t max_level) {
  const std::vector<std::uint64_t> levels = levels_dense_at_start(max_level, kCubicFitSteps);
  const auto count = static_cast<Index>(levels.size());
  Eigen::MatrixXd design(count, CubicFit::kRank);
  for (Index l = 0; l < count; ++l) {
    const auto basis = cubic_basis(levels[static_cast<std::size_t>(l)], max_level);
    for (Index p = 0; p < CubicFit::kRank; ++p) design(l, p) = basis[static_cast<std::size_t>(p)];
  }
  // The least-squares fit is linear in the data. With the levels L_l numbered by l, and the
  // displacements S_{L_l} x − x by the smoothing to these levels, field c_p of the fit is
  //   c_p = Σ_l P_pl (S_{L_l} x − x),
  // where P is the pseudo-inverse of the design matrix. If there are fewer than four levels, P
  // gives the smallest coefficients that interpolate the levels. Because the fit is linear, the
  // Chebyshev series of all levels can be combined into one series for each field.
  const Eigen::MatrixXd fit =
      design.completeOrthogonalDecomposition().solve(Eigen::MatrixXd::Identity(count, count));
  std::vector<ChebyshevSeries> combined(CubicFit::kRank);
  for (Index l = 0; l < count; ++l) {
    const ChebyshevSeries series = power_series(filter.kind(), levels[static_cast<std::size_t>(l)]);
    for (Index p = 0; p < CubicFit::kRank; ++p) {
      ChebyshevSeries& sum = combined[static_cast<std::size_t>(p)];
      if (sum.size() < series.size()) sum.resize(series.size(), 0.0);
      for (std::size_t k = 0; k < series.size(); ++k) sum[k] += fit(p, l) * series[k];
      sum[0] -= fit(p, l);  // − x = − T_0(W) x
    }
  }
  std::vector<float> fields;
  for (const Positions& field : filter_many(filter, positions, std::move(combined))) {
    for (Index i = 0; i < field.size(); ++i) fields.push_back(static_cast<float>(field.data()[i]));
  }
  return {max_level, quantize(fields, positions.rows())};
}

}  // namespace crowdface
