// SPDX-License-Identifier: Apache-2.0
#include "crowdface/traits/trait_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "crowdface/core/text.h"

namespace crowdface {

TraitLimits merge_limits(const TraitLimits& defaults, const TraitLimits& limits) {
  TraitLimits all = limits;
  for (const TraitLimit& limit : defaults) {
    if (std::ranges::find(limits, limit.trait, &TraitLimit::trait) == limits.end())
      all.push_back(limit);
  }
  std::ranges::sort(all, {}, &TraitLimit::trait);
  return all;
}

TraitDistributions::TraitDistributions(const std::vector<std::vector<std::optional<double>>>& heads,
                                       std::vector<TraitTarget> table)
    : sorted_values_(measurements().size()), target_distributions_(std::move(table)) {
  for (const auto& head : heads) {
    for (std::size_t m = 0; m < head.size(); ++m) {
      if (head[m]) sorted_values_[m].push_back(*head[m]);
    }
  }
  for (std::vector<double>& values : sorted_values_) std::ranges::sort(values);
}

double TraitDistributions::quantile(std::size_t trait, double fraction) const {
  const auto row = std::ranges::find(target_distributions_, trait, &TraitTarget::trait);
  if (row != target_distributions_.end()) return normal_quantile(*row, fraction);
  const std::vector<double>& values = sorted_values_[trait];
  const double at = fraction * static_cast<double>(values.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), values.size() - 1);
  const auto above = std::min(below + 1, values.size() - 1);
  const double t = at - static_cast<double>(below);
  return (1 - t) * values[below] + t * values[above];
}

double TraitDistributions::mean(std::size_t trait) const {
  double sum = 0;
  for (const double value : sorted_values_[trait]) sum += value;
  return sum / static_cast<double>(sorted_values_[trait].size());
}

double TraitDistributions::deviation(std::size_t trait) const {
  const double middle = mean(trait), count = static_cast<double>(sorted_values_[trait].size());
  double squares = 0;
  for (const double value : sorted_values_[trait]) squares += (value - middle) * (value - middle);
  return count > 1 ? std::sqrt(squares / (count - 1)) : 0;
}

bool TraitDistributions::meets(const TraitLimit& limit, double value) const {
  return !(limit.at_least && value < bound_value(limit.trait, *limit.at_least)) &&
         !(limit.at_most && value > bound_value(limit.trait, *limit.at_most));
}

std::string format_trait(const Measurement& measurement, double value) {
  const std::string_view unit = unit_of(measurement);
  return concat(format_fixed(value, unit.empty() ? 3 : 1), unit);
}

double normal_cdf(const TraitTarget& target, double value) {
  constexpr double kSteps = 1e9;
  const double z = (value - target.mean) / target.deviation;
  return std::round(0.5 * std::erfc(-z / std::numbers::sqrt2) * kSteps) / kSteps;
}

double normal_quantile(const TraitTarget& target, double fraction) {
  constexpr double kFarthest = 6, kSteps = 1e6;
  const TraitTarget standard{0, 0, 1};
  double low = -kFarthest, high = kFarthest;
  while (high - low > 0.1 / kSteps) {
    const double middle = (low + high) / 2;
    (normal_cdf(standard, middle) < fraction ? low : high) = middle;
  }
  return target.mean + target.deviation * std::round(high * kSteps) / kSteps;
}

double kolmogorov_smirnov_distance(const TraitTarget& target, std::vector<double> values) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double asked = normal_cdf(target, values[i]);
    most = std::max({most, std::abs(asked - static_cast<double>(i) / count),
                     std::abs(asked - static_cast<double>(i + 1) / count)});
  }
  return most;
}

}  // namespace crowdface
