// SPDX-License-Identifier: Apache-2.0
// Landmarks and measurements of the heads of a config.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/parts/surface_point.h"
#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// The landmarks of a config's heads: points on the common mesh topology of all heads and faces.
struct HeadLandmarks {
  /// for each of trait_landmarks(): the landmark's point; empty if the point is unknown
  std::vector<std::optional<SurfacePoint>> surface_points;
  /// for each of trait_landmarks(): why the point is unknown; empty if the point is known
  std::vector<std::string> missing_reasons;

  /// Returns whether the positions of all landmarks of a measurement are known.
  bool can_measure(const Measurement& measurement) const;
  /// Returns why a measurement is not available, for example "no hairline (…)".
  /// \pre can_measure(measurement) is false.
  std::string missing_landmark_reason(const Measurement& measurement) const;
  /// The positions of the landmarks on a mesh, #landmarks by 3, in millimetres. A landmark whose
  /// position is unknown has a zero row.
  Positions landmark_positions(const Positions& mesh, double mm_per_unit) const;
};

/// Finds the landmarks on the mean of the heads, or reads them from the config's landmark file.
/// \throws UsageError if the file has a position that is not on the heads, or a name that no
///   landmark has.
HeadLandmarks find_head_landmarks(const Config& config, const Inputs& inputs);

/// The values of all measurements on a mesh, in the order of the measurements; an unavailable value
/// is empty.
std::vector<std::optional<double>> measure_mesh(const HeadLandmarks& landmarks,
                                                const Positions& mesh, double mm_per_unit);

/// The distributions of the measurements over all heads.
TraitDistributions measure_heads(const Config& config, const Inputs& inputs,
                                 const HeadLandmarks& landmarks);

/// The heads' values of the measurements that the config names: #heads by #named measurements.
std::vector<std::vector<double>> head_traits_of_config(const Config& config, const Inputs& inputs);

/// Checks that all measurements that the config names are available on these heads. \throws
/// UsageError if one of these measurements is not available.
void require_available_traits(const Config& config, const HeadLandmarks& landmarks);

/// A text table of the measurements of all heads. The table also lists unavailable measurements.
std::string format_head_traits(const Config& config, const Inputs& inputs,
                               const HeadLandmarks& landmarks);

}  // namespace crowdface
