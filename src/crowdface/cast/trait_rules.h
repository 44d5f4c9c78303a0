// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_measurer.h"

namespace crowdface {

/// The limits on measurements of each face of a crowd.
class TraitRules {
 public:
  /// \param measurer, casting  must outlive this object.
  TraitRules(const FaceMeasurer& measurer, const CastingOptions& casting)
      : measurer_(measurer), casting_(casting) {}

  /// The limits of a face: a hand-written face has its recipe's limits; a member of a family has
  /// the limits of the family and of the family's group; a face in a group has the group's limits;
  /// any other face has the crowd's limits. A face without an id is hidden and has no limits.
  TraitLimits limits_of(const FacePlan& face) const;
  /// Checks the limits of a face. Returns nothing if the landmarks meet the limits.
  /// \param landmarks  from FaceMeasurer::landmarks or exact_landmarks
  std::optional<Reason> check(const FacePlan& face, const Positions& landmarks) const;
  const FaceMeasurer& measurer() const { return measurer_; }

 private:
  const FaceMeasurer& measurer_;
  const CastingOptions& casting_;
};

/// Whether any face of the crowd has limits.
bool has_trait_limits(const CastingOptions& casting);

/// Largest number of candidates for one face if measurements are limited, as a multiple of
/// DiversityOptions::max_attempts. Generating and measuring a candidate takes microseconds.
inline constexpr std::uint32_t kAttemptFactorWithTraits = 20;
/// Returns kAttemptFactorWithTraits if the crowd has limits on measurements, otherwise 1.
std::uint32_t attempt_factor(const CastingOptions& casting);

}  // namespace crowdface
