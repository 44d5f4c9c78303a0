// SPDX-License-Identifier: Apache-2.0
// Limits on the measurements of faces.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/traits/measurements.h"

namespace crowdface {

/// The lower or upper bound of a limit.
struct TraitBound {
  double value = 0;  ///< in the measurement's unit, or a quantile from 0 to 1
  /// whether `value` is a quantile of the heads or of a table, see TraitDistributions
  bool is_quantile = false;
  bool operator==(const TraitBound&) const = default;
};

/// The allowed range of a measurement of a face. A limit without bounds does not restrict faces; it
/// only adds the measurement to reports.
struct TraitLimit {
  std::size_t trait = 0;  ///< index into measurements()
  std::optional<TraitBound> at_least = {}, at_most = {};
  bool operator==(const TraitLimit&) const = default;
};
/// Limits, ascending by trait, at most one for each trait.
using TraitLimits = std::vector<TraitLimit>;

/// The normal distribution of a measurement, from a table.
struct TraitTarget {
  std::size_t trait = 0;
  double mean = 0, deviation = 0;
  bool operator==(const TraitTarget&) const = default;
};

/// Returns the limits of `own`, and those limits of `common` whose traits have no limit in `own`.
TraitLimits merge_limits(const TraitLimits& common, const TraitLimits& own);

/// The distributions of the measurements over the heads, which give the quantiles for limits.
class TraitDistributions {
 public:
  /// \param heads  for each head, the values of all measurements in the table's order; nothing if a
  /// measurement is not available.
  /// \param table  distributions that replace the heads for the quantiles of their measurements
  explicit TraitDistributions(const std::vector<std::vector<std::optional<double>>>& heads,
                              std::vector<TraitTarget> table = {});

  bool is_available(std::size_t trait) const { return !sorted_values_[trait].empty(); }
  /// The values of the heads, ascending. \pre the trait is available, as for all functions below.
  const std::vector<double>& sorted_values(std::size_t trait) const {
    return sorted_values_[trait];
  }
  /// A quantile of the trait: of the table's distribution if the table has the trait
  /// (normal_quantile), otherwise interpolated linearly between the values of the heads. 0 gives
  /// the smallest value, 1 the largest value.
  double quantile(std::size_t trait, double share) const;
  double bound_value(std::size_t trait, const TraitBound& bound) const {
    return bound.is_quantile ? quantile(trait, bound.value) : bound.value;
  }
  double mean(std::size_t trait) const;
  /// Standard deviation of the trait; 0 for a single head.
  double deviation(std::size_t trait) const;
  bool meets(const TraitLimit& limit, double value) const;

 private:
  /// #measurements: the values of the heads, ascending
  std::vector<std::vector<double>> sorted_values_;
  std::vector<TraitTarget> table_;
};

/// Returns a value with its unit: "38.2 mm", "104.1 degrees", "0.672".
std::string format_trait(const Measurement& measurement, double value);

/// Returns the fraction of a normal distribution below a value, rounded to 10⁻⁹, because error
/// functions differ between C libraries.
double normal_fraction_below(const TraitTarget& target, double value);

/// Returns the value below which the given fraction of a normal distribution lies, rounded to 10⁻⁶
/// standard deviations. The fractions 0 and 1 give the values six standard deviations below and
/// above the mean.
double normal_quantile(const TraitTarget& target, double share);

/// Returns the Kolmogorov-Smirnov statistic: the largest difference, from 0 to 1, between the
/// cumulative distributions of the values and of the target.
double kolmogorov_smirnov_distance(const TraitTarget& target, std::vector<double> values);

}  // namespace crowdface
