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

/// The landmarks of a config's heads: points on the topology that all heads and faces share.
struct HeadLandmarks {
  std::vector<std::optional<SurfacePoint>> surface_points;  ///< #trait_landmarks
  std::vector<std::string>
      missing_reasons;  ///< #trait_landmarks: why the landmark has no point; or empty

  /// Returns whether the positions of all landmarks of a measurement are known.
  bool can_measure(const Measurement& measurement) const;
  /// Why a measurement is not available: "no hairline (…)". \pre `can_measure` is false.
  std::string missing_landmark_reason(const Measurement& measurement) const;
  /// The landmarks on a mesh, #landmarks by 3, in millimetres. Rows of landmarks whose position is
  /// unknown are zero.
  Positions landmark_positions(const Positions& mesh, double mm_per_unit) const;
};

/// Finds the landmarks on the mean of the heads, or reads them from the config's landmark file.
/// \throws UsageError if the file has a position that is not on the heads, or a name that is not a
///   landmark's.
HeadLandmarks find_head_landmarks(const Config& config, const Inputs& inputs);

/// The measurements of a mesh: #measurements; unavailable measurements are empty.
std::vector<std::optional<double>> measure_mesh(const HeadLandmarks& landmarks,
                                                const Positions& mesh, double mm_per_unit);

/// The measurements of all heads.
TraitDistributions measure_heads(const Config& config, const Inputs& inputs,
                                 const HeadLandmarks& landmarks);

/// The values of the measurements that the config names: #heads by #named.
std::vector<std::vector<double>> named_head_traits(const Config& config, const Inputs& inputs);

/// \throws UsageError if the config names a measurement that is not available on these heads.
void require_named_traits(const Config& config, const HeadLandmarks& landmarks);

/// A readable table of the measurements of all heads; it also lists unavailable measurements.
std::string format_head_traits(const Config& config, const Inputs& inputs,
                               const HeadLandmarks& landmarks);

}  // namespace crowdface
