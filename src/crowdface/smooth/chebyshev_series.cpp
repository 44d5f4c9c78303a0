// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/chebyshev_series.h"

#include <cmath>

namespace crowdface {
namespace {

/// The sum of the coefficients. The smallest terms are added first, for accuracy.
double accurate_sum(const ChebyshevSeries& series) {
  double sum = 0;
  for (auto a = series.rbegin(); a != series.rend(); ++a) sum += *a;
  return sum;
}

}  // namespace

ChebyshevSeries power_series(OperatorKind kind, std::uint64_t level, double tolerance) {
  if (level == 0) return {1.0};
  const bool lazy = kind == OperatorKind::kLazy;
  const double l = static_cast<double>(level);
  // L is the level, and C(n, m) is the binomial coefficient. In both series a_0 is halved.
  // Umbrella operator: a_k = 2^{1−L} C(L, (L−k)/2) for k ≡ L (mod 2).
  //   So a_{k+2}/a_k = (L−k)/(L+k+2).
  // Lazy operator: a_k = 2^{1−2L} C(2L, L−k). So a_{k+1}/a_k = (L−k)/(L+k+1).
  const std::uint64_t stride = lazy ? 1 : 2;
  const std::uint64_t start = lazy ? 0 : level % 2;
  ChebyshevSeries series(start, 0.0);
  double term = 1, sum = 0;
  for (std::uint64_t k = start; k <= level; k += stride) {
    if (k > start) series.resize(k, 0.0);
    series.push_back(k == 0 ? 0.5 * term : term);
    sum += series.back();
    const double kd = static_cast<double>(k);
    const double ratio = (l - kd) / (l + kd + static_cast<double>(stride));
    term *= ratio;
    // The ratios of successive terms decrease, so a geometric series bounds the sum of the
    // remaining terms.
    if (term <= tolerance * sum * (1 - ratio)) break;
  }
  const double total = accurate_sum(series);
  // The sum must be exactly 1, or fixed boundaries would drift.
  for (double& a : series) a /= total;
  return series;
}

ChebyshevSeries displacement_series(OperatorKind kind, std::uint64_t level, double tolerance) {
  ChebyshevSeries series = power_series(kind, level, tolerance);
  series[0] -= 1;  // − x = − T_0(W) x
  return series;
}

double coefficient_sum(const ChebyshevSeries& series) {
  const double sum = accurate_sum(series);
  constexpr double kRounding = 1e-12;
  if (std::abs(sum - 1) < kRounding) return 1;
  return std::abs(sum) < kRounding ? 0 : sum;
}

}  // namespace crowdface
