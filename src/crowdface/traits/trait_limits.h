// SPDX-License-Identifier: Apache-2.0
// Limits on the measurements of faces.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/traits/measurements.h"

namespace crowdface {

/// An end of a limit.
struct TraitEnd {
  double value = 0;          ///< in the measurement's unit, or a quantile from 0 to 1
  bool is_quantile = false;  ///< of the heads or of a table, see TraitSpread
  bool operator==(const TraitEnd&) const = default;
};

/// The range that a measurement of a face must be in. Without ends, the trait is only reported.
struct TraitLimit {
  std::size_t trait = 0;  ///< index into measurements()
  std::optional<TraitEnd> at_least = {}, at_most = {};
  bool operator==(const TraitLimit&) const = default;
};
/// Limits, ascending by trait, at most one for each.
using TraitLimits = std::vector<TraitLimit>;

/// A measurement's normal distribution, in a table.
struct TraitTarget {
  std::size_t trait = 0;
  double mean = 0, deviation = 0;
  bool operator==(const TraitTarget&) const = default;
};

/// Returns the limits of `own`, and the limits of `common` on all other traits.
TraitLimits with_own(const TraitLimits& common, const TraitLimits& own);

/// The values of the heads, and the quantiles that limits may name.
class TraitSpread {
 public:
  /// \param heads  for each head, the values of all measurements in the table's order; nothing where
  ///               a measurement is not available.
  /// \param table  distributions that give the quantiles of their measurements in place of the heads
  explicit TraitSpread(const std::vector<std::vector<std::optional<double>>>& heads,
                       std::vector<TraitTarget> table = {});

  bool is_available(std::size_t trait) const { return !ascending_[trait].empty(); }
  /// The values of the heads, ascending. \pre the trait is available, as for all functions below.
  const std::vector<double>& ascending(std::size_t trait) const { return ascending_[trait]; }
  /// A quantile of the table's distribution if it has the trait, see normal_quantile; otherwise
  /// interpolates linearly between the values of the heads: 0 gives the least, 1 the greatest.
  double quantile(std::size_t trait, double share) const;
  double value_of(std::size_t trait, const TraitEnd& end) const {
    return end.is_quantile ? quantile(trait, end.value) : end.value;
  }
  double mean(std::size_t trait) const;
  /// Standard deviation; 0 for a single head.
  double deviation(std::size_t trait) const;
  bool meets(const TraitLimit& limit, double value) const;

 private:
  std::vector<std::vector<double>> ascending_;  ///< #measurements
  std::vector<TraitTarget> table_;
};

/// A value with its unit: "38.2 mm", "104.1 degrees", "0.672".
std::string format_trait(const Measurement& measurement, double value);

/// Share of a normal distribution below a value, rounded to 10⁻⁹, because the C library's error
/// functions differ between versions.
double normal_share(const TraitTarget& target, double value);

/// The value below which a share of a normal distribution lies. 0 and 1 give the values six
/// standard deviations from the mean. Rounded to 10⁻⁶ standard deviations.
double normal_quantile(const TraitTarget& target, double share);

/// The largest difference between the distribution of values and the asked one, from 0 to 1 (the
/// statistic of Kolmogorov and Smirnov).
double largest_difference(const TraitTarget& target, std::vector<double> values);

}  // namespace crowdface
