// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/plausibility.h"

#include <cmath>

#include "crowdface/core/fixed_order.h"

namespace crowdface {
namespace {

/// this fraction of the heads' mean variance is added to the variance in every direction
constexpr double kRidge = 0.1;

}  // namespace

Plausibility::Metric Plausibility::metric_without(const std::vector<Eigen::VectorXf>& heads,
                                                  Index head_count, Index left_out_head) {
  Metric metric;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    if (static_cast<Index>(h) % head_count == left_out_head) continue;
    metric.head_offsets.emplace_back(heads[h].data(), heads[h].data() + heads[h].size());
  }
  const std::size_t count = metric.head_offsets.size();
  metric.mean.assign(metric.head_offsets[0].size(), 0.0);
  for (const auto& head : metric.head_offsets) {
    for (std::size_t d = 0; d < head.size(); ++d) metric.mean[d] += head[d];
  }
  for (double& value : metric.mean) value /= static_cast<double>(count);
  double variance = 0;
  for (auto& head : metric.head_offsets) {
    for (std::size_t d = 0; d < head.size(); ++d) head[d] -= metric.mean[d];
    variance += fixed_order_dot(head, head);
  }
  const double freedom = std::max<double>(static_cast<double>(count) - 1, 1);
  metric.ridge = std::max(kRidge * variance / (freedom * freedom), 1e-12);
  std::vector<std::vector<double>> gram(count, std::vector<double>(count));
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      gram[a][b] = gram[b][a] = fixed_order_dot(metric.head_offsets[a], metric.head_offsets[b]);
    }
    gram[a][a] += metric.ridge * freedom;
  }
  metric.cholesky_factor = cholesky(std::move(gram), count);
  return metric;
}

/// Returns the squared Mahalanobis distance zᵀ (Σ + ridge·I)⁻¹ z. Here z is the point minus the
/// mean of the H heads, Y has one row of `head_offsets` per head, and Σ = YᵀY/(H − 1). The Woodbury
/// identity gives (‖z‖² − (Y z)ᵀ (ridge·(H − 1)·I + Y Yᵀ)⁻¹ (Y z)) / ridge.
double Plausibility::squared_distance(const Metric& metric, const Eigen::VectorXf& point) {
  std::vector<double> z(metric.mean.size()), along;
  for (std::size_t d = 0; d < z.size(); ++d) {
    z[d] = static_cast<double>(point[static_cast<Index>(d)]) - metric.mean[d];
  }
  for (const auto& head : metric.head_offsets) along.push_back(fixed_order_dot(head, z));
  const std::vector<double> solved =
      solve_lower(metric.cholesky_factor, std::move(along), metric.cholesky_factor.size());
  return (fixed_order_dot(z, z) - fixed_order_dot(solved, solved)) / metric.ridge;
}

Plausibility::Plausibility(const FaceSpace& space) {
  std::vector<Eigen::VectorXf> heads;
  const Index count = space.head_count();
  for (Index h = 0; h < space.head_point_count(); ++h) {
    heads.push_back(space.head_point(h).coordinates_with_extrapolation);
  }
  metric_ = metric_without(heads, count, -1);
  // With three or more heads, leave out each head in turn. With two heads, the remaining head would
  // have no variance, so use the first head's distance without leaving out a head.
  if (count < 3) {
    typical_distance_ = std::sqrt(squared_distance(metric_, heads[0]));
  } else {
    double sum = 0;
    for (Index h = 0; h < count; ++h) {
      sum += squared_distance(metric_without(heads, count, h), heads[static_cast<std::size_t>(h)]);
    }
    typical_distance_ = std::sqrt(sum / static_cast<double>(count));
  }
  if (!(typical_distance_ > 0)) typical_distance_ = 1;
}

double Plausibility::score(const FaceSpace::Point& point) const {
  return std::sqrt(std::max(squared_distance(metric_, point.coordinates_with_extrapolation), 0.0)) /
         typical_distance_;
}

}  // namespace crowdface
