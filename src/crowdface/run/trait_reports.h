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

/// A measurement of the faces of a crowd, for reports.
struct TraitReport {
  std::size_t trait = 0;
  Quartiles heads, crowd;
  /// Only for a measurement with a requested distribution. `difference`: largest difference between
  /// the requested cumulative distribution and the sampled faces' (Kolmogorov and Smirnov).
  /// `below`, `above`: fractions of the requested distribution below and above all values of random
  /// faces.
  struct Comparison {
    TraitTarget target;
    double mean = 0, deviation = 0;  ///< mean and standard deviation of the sampled faces
    double difference = 0, below = 0, above = 0;
  };
  std::optional<Comparison> comparison;
};
/// \param crowd  measured faces, see measure_faces
std::vector<TraitReport> report_traits(const CastingOptions& casting, const FaceTraits& traits,
                                       const std::vector<FacePlan>& crowd);

/// Warnings about requested distributions that the crowd does not have.
std::vector<std::string> population_warnings(const std::vector<TraitReport>& reports);

/// A readable table of all measurements: the range of values that faces made from these heads have.
std::string format_trait_ranges(const Config& config, const Inputs& inputs,
                                const Prepared& prepared, const CastingOptions& casting);

}  // namespace crowdface
