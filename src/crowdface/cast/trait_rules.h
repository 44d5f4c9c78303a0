// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_measurer.h"

namespace crowdface {

/// Which limits on measurements hold for which face of a crowd.
class TraitRules {
 public:
  /// \param measurer, casting  must outlive this object.
  TraitRules(const FaceMeasurer& measurer, const CastingOptions& casting)
      : measurer_(measurer), casting_(casting) {}

  /// The limits of a face: of its recipe if it is written by hand; of its family and the family's
  /// group; of its group; else of the crowd. A face without an id is hidden and has no limits.
  TraitLimits limits_of(const FacePlan& face) const;
  /// Checks the limits of a face.
  /// \param landmarks  from FaceMeasurer::landmarks or exact_landmarks
  std::optional<Reason> check(const FacePlan& face, const Positions& landmarks) const;
  const FaceMeasurer& measurer() const { return measurer_; }

 private:
  const FaceMeasurer& measurer_;
  const CastingOptions& casting_;
};

/// Whether any face of the crowd has limits.
bool has_trait_limits(const CastingOptions& casting);

/// Most draws for one face if measurements are limited, as a multiple of DiversityOptions::max_attempts:
/// drawing and measuring take microseconds.
inline constexpr std::uint32_t kDrawsWithTraits = 20;
/// Returns kDrawsWithTraits if the crowd has limits on measurements, otherwise 1.
std::uint32_t draws_factor(const CastingOptions& casting);

}  // namespace crowdface
