// SPDX-License-Identifier: Apache-2.0
// Messages to the user about crowds that may be, or are, impossible to cast.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/capacity_forecast.h"
#include "crowdface/cast/feasibility.h"
#include "crowdface/config/config.h"
#include "crowdface/run/face_traits.h"

namespace crowdface {

/// Watches casting in the mode first_fit. Logs a warning if the forecast says that the crowd will
/// not reach the requested number of faces. Before this warning, may log that a face needed many
/// candidates. Logs each of these two messages at most once.
class ScarcityWarning {
 public:
  /// \param casting  must outlive this object.
  explicit ScarcityWarning(const CastingOptions& casting) : casting_(casting) {}
  /// Call this after each accepted face. \param rejected  the rejected candidates for this face
  void on_face_accepted(const RejectionCounts& rejected);

 private:
  const CastingOptions& casting_;
  CapacityForecast forecast_;          ///< estimates the number of faces at which casting will end
  std::uint64_t cast_face_count_ = 0;  ///< number of faces that casting has accepted so far
  bool has_warned_ = false;
  bool has_logged_scarcity_ = false;
};

/// Explains why limits on measurements could not be met. Returns a line for each limit, with the
/// share of sampled faces that meet the limit, the range of the sampled faces' values, and the
/// heads with the most extreme values.
/// \param shortfall  names the group, family or recipe whose limits could not be met
std::vector<std::string> trait_advice(const Config& config, const Inputs& inputs,
                                      const CastingOptions& casting, const FaceTraits& traits,
                                      const Shortfall& shortfall);

/// Reports that a crowd cannot be cast.
/// \throws Unsatisfiable; the message names the constraint that prevented more faces, the number of
///     faces that were cast, and a change that would help.
/// \param trait_advice_lines  if limits on measurements prevented more faces: a line for each
///                      limit, from trait_advice
[[noreturn]] void throw_shortfall(const Config& config, const Remedy& remedy,
                                  const Shortfall& shortfall,
                                  const std::vector<std::string>& trait_advice_lines = {});

}  // namespace crowdface
