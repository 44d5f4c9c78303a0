// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_measurer.h"

namespace crowdface {

/// Finds the limits on measurements that apply to a face of a crowd, and checks the face against
/// these limits.
class TraitRules {
 public:
  /// \param measurer, casting  must outlive this object.
  TraitRules(const FaceMeasurer& measurer, const CastingOptions& casting)
      : measurer_(&measurer), casting_(&casting) {}

  /// Returns the limits that apply to a face. A hand-written face has the limits of its recipe. A
  /// member of a family has the limits of the family, and also the limits of the family's group or,
  /// if the family has no group, of the crowd. A face in a group has the group's limits. All other
  /// faces have the crowd's limits, except faces without an index and an id, which are not part of
  /// the crowd and have no limits.
  TraitLimits limits_of(const FacePlan& face) const;
  /// Checks whether a face's landmarks meet the limits that apply to the face (see limits_of).
  /// Returns nothing if they do, otherwise kTraits.
  ///
  /// \param landmarks  from FaceMeasurer::landmarks or exact_landmarks
  std::optional<RejectionReason> check(const FacePlan& face, const Positions& landmarks) const;
  const FaceMeasurer& measurer() const { return *measurer_; }

 private:
  const FaceMeasurer* measurer_;
  const CastingOptions* casting_;
};

/// Returns whether any face of the crowd has limits on measurements.
bool has_trait_limits(const CastingOptions& casting);

/// Largest number of candidates for one face if the config limits measurements, as a multiple of
/// DiversityOptions::max_attempts. The number may be large, because generating and measuring a
/// candidate takes microseconds.
inline constexpr std::uint32_t kAttemptFactorWithTraits = 20;
/// Returns the factor on DiversityOptions::max_attempts: kAttemptFactorWithTraits if the crowd has
/// limits on measurements, otherwise 1.
std::uint32_t max_attempts_factor(const CastingOptions& casting);

}  // namespace crowdface
