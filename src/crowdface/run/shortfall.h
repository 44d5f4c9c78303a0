// SPDX-License-Identifier: Apache-2.0
// What a user is told where a crowd cannot be cast, or may not.
#pragma once

#include <cstdint>

#include "crowdface/cast/capacity_forecast.h"
#include "crowdface/cast/feasibility.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Warns early, and once, that a crowd may not get full.
class ScarcityWarning {
 public:
  /// \param casting  must outlive this object.
  explicit ScarcityWarning(const Casting& casting) : casting_(casting) {}
  /// \param thrown  the candidates that were thrown away for the face that joined.
  void face_joined(const Rejections& thrown);

 private:
  const Casting& casting_;
  CapacityForecast forecast_;
  std::uint64_t cast_ = 0;
  bool foreseen_ = false;
  bool scarce_ = false;
};

/// \throws Unsatisfiable with what binds, how far casting went, and what would help.
[[noreturn]] void tell_shortfall(const Config& config, const Remedy& remedy,
                                 const Shortfall& shortfall);

}  // namespace crowdface
