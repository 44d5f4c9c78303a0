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
  /// Only for a measurement with an asked distribution: the largest difference between it and that
  /// of the sampled faces (Kolmogorov and Smirnov), and the share of the asked distribution that
  /// lies below and above the values of drawn faces.
  struct Asked {
    TraitTarget target;
    double mean = 0, deviation = 0;  ///< of the sampled faces
    double difference = 0, below = 0, above = 0;
  };
  std::optional<Asked> asked;
};
/// \param crowd  measured faces, see measure_faces
std::vector<TraitReport> report_traits(const CastingOptions& casting, const FaceTraits& traits,
                                       const std::vector<FacePlan>& crowd);

/// Warnings about asked distributions that the crowd does not have.
std::vector<std::string> population_warnings(const std::vector<TraitReport>& reports);

/// A readable table of the ranges that faces of these heads fill, for all measurements.
std::string format_trait_ranges(const Config& config, const Inputs& inputs,
                                const Prepared& prepared, const CastingOptions& casting);

}  // namespace crowdface
