// SPDX-License-Identifier: Apache-2.0
// Reports on the measurements of a crowd.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/crowd_statistics.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/run/face_traits.h"

namespace crowdface {

/// The statistics of one measurement over the faces of a crowd, for reports.
struct TraitReport {
  std::size_t trait_index = 0;  ///< index of the measurement in measurements()
  /// quartiles of the measurement over the heads, and over the faces of the crowd
  Quartiles head_values, crowd_values;
  /// Compares the sampled faces with the distribution that the config requests.
  struct TargetComparison {
    TraitTarget target;                       ///< the requested distribution
    double mean = 0, standard_deviation = 0;  ///< mean and standard deviation of the sampled faces
    /// largest difference between the cumulative distributions of the sampled faces and of the
    /// request, see kolmogorov_smirnov_distance
    double max_difference = 0;
    /// The values of random faces, which need not satisfy the limits, form a range. These are the
    /// fractions of the requested distribution below this range and above this range.
    double fraction_below = 0, fraction_above = 0;
  };
  std::optional<TargetComparison> comparison;  ///< empty if the config requests no distribution
};
/// Computes the statistics of each measurement that the config names.
/// \param crowd  measured faces, see measure_faces
std::vector<TraitReport> report_traits(const CastingOptions& casting, const FaceTraits& traits,
                                       const std::vector<FacePlan>& crowd);

/// Warnings about measurements whose distribution in the crowd differs from the requested
/// distribution.
std::vector<std::string> population_warnings(const std::vector<TraitReport>& reports);

/// A text table with the range of each measurement, among the heads and among random faces.
std::string format_trait_ranges(const Config& config, const Inputs& inputs,
                                const PreparedHeads& prepared, const CastingOptions& casting);

}  // namespace crowdface
