// SPDX-License-Identifier: Apache-2.0
// Limits on the measurements ("traits") of faces.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/traits/measurements.h"

namespace crowdface {

/// The lower or the upper bound of a TraitLimit.
struct TraitBound {
  double value = 0;  ///< in the measurement's unit or, if `is_quantile`, a quantile from 0 to 1
  /// whether `value` is a quantile of a distribution (of the heads or of a table, see
  /// TraitDistributions)
  bool is_quantile = false;
  bool operator==(const TraitBound&) const = default;
};

/// The range that a measurement of a face may have. A limit without bounds does not restrict faces,
/// but reports then include the measurement.
struct TraitLimit {
  std::size_t trait = 0;  ///< the measurement, as an index into measurements()
  /// the lower and the upper bound, if they exist
  std::optional<TraitBound> at_least = {}, at_most = {};
  bool operator==(const TraitLimit&) const = default;
};
/// Limits sorted by trait, with at most one limit for each trait.
using TraitLimits = std::vector<TraitLimit>;

/// The normal distribution of one measurement, as a table gives it.
struct TraitTarget {
  std::size_t trait = 0;  ///< the measurement, as an index into measurements()
  /// mean and standard deviation of the distribution, in the measurement's unit
  double mean = 0, deviation = 0;
  bool operator==(const TraitTarget&) const = default;
};

/// Returns all of `limits`, and the default limits of the traits that have no limit in `limits`.
TraitLimits merge_limits(const TraitLimits& defaults, const TraitLimits& limits);

/// The distributions of the measurements, from the heads or from a table. The distributions convert
/// quantiles in limits to values.
class TraitDistributions {
 public:
  /// \param heads  for each head, the values of all measurements in the order of measurements();
  ///               nothing for a measurement that is not available.
  /// \param table  normal distributions of some measurements, which replace the heads'
  ///               distributions of these measurements.
  explicit TraitDistributions(const std::vector<std::vector<std::optional<double>>>& heads,
                              std::vector<TraitTarget> table = {});

  /// Returns whether the value of the measurement is known for at least one head.
  bool is_available(std::size_t trait) const { return !sorted_values_[trait].empty(); }
  /// Returns the values of the heads, ascending.
  ///
  /// \pre `is_available(trait)`. All functions below have the same precondition.
  const std::vector<double>& sorted_values(std::size_t trait) const {
    return sorted_values_[trait];
  }
  /// Returns a quantile of the trait. If the table contains the trait, this is a quantile of the
  /// table's normal distribution (normal_quantile). Otherwise the quantile is interpolated linearly
  /// between the values of the heads: 0 gives the smallest value, 1 the largest value.
  double quantile(std::size_t trait, double fraction) const;
  /// Returns the value of a bound in the measurement's unit: converts a quantile to a value.
  double bound_value(std::size_t trait, const TraitBound& bound) const {
    return bound.is_quantile ? quantile(trait, bound.value) : bound.value;
  }
  /// Returns the mean of the trait over the heads.
  double mean(std::size_t trait) const;
  /// Returns the standard deviation of the trait over the heads; 0 if there is only one head.
  double deviation(std::size_t trait) const;
  /// Returns whether the value of a face's measurement lies within the limit.
  bool meets(const TraitLimit& limit, double value) const;

 private:
  /// #measurements: for each measurement, the values of the heads, ascending
  std::vector<std::vector<double>> sorted_values_;
  /// Normal distributions of some measurements, from the constructor's parameter `table`. For these
  /// measurements, they replace the distribution over the heads.
  std::vector<TraitTarget> target_distributions_;
};

/// Returns a value with its unit, such as "38.2 mm", "104.1 degrees" or "0.672".
std::string format_trait(const Measurement& measurement, double value);

/// Cumulative distribution function: returns the fraction of the target's normal distribution that
/// is below a value. The fraction is rounded to 10⁻⁹, because error functions differ between C
/// libraries.
double normal_cdf(const TraitTarget& target, double value);

/// Returns the value below which the given fraction of a normal distribution lies. The value is
/// rounded to 10⁻⁶ standard deviations. For the fractions 0 and 1, returns the mean minus and plus
/// six standard deviations.
double normal_quantile(const TraitTarget& target, double fraction);

/// Returns the Kolmogorov-Smirnov statistic: the largest difference, from 0 to 1, between the
/// cumulative distribution of the values and the cumulative distribution of the target.
double kolmogorov_smirnov_distance(const TraitTarget& target, std::vector<double> values);

}  // namespace crowdface
