// SPDX-License-Identifier: Apache-2.0
// The constraints on faces: a table with the config key, the limit and the advice for each.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/diversity.h"

namespace crowdface {

/// The constraint that a rejected candidate violates.
enum class RejectionReason {
  kMinDistance,         ///< the face is too near to another face of the crowd
  kMinDistanceToHeads,  ///< the face is too near to an input head
  kMaxWeight,           ///< one head has too much weight in a region
  kImplausible,         ///< the face differs too much from the mean of the heads to be believable
  kFlipped,             ///< part of the skin is turned inside out or collapsed
  kStretched,           ///< part of the skin is stretched too far
  kIntersecting,        ///< the face's skin intersects itself where the target's skin does not
  /// the gap between the lips, or between other parts of the skin that nearly touch, is wider than
  /// in any head
  kGap,
  kExposed,  ///< the back side of the skin is visible near an intersection
  /// the face is too near to another family, or the face is a member of a family and breaks one of
  /// the family's distance limits (see FamilySampler::rejection_reason)
  kFamily,
  kRejected,  ///< the face is too similar to a face that a review rejected
  kTraits,    ///< a measurement of the face is outside its limits
};
constexpr auto kReasonCount = static_cast<std::size_t>(RejectionReason::kTraits) + 1;

/// A constraint on faces, with the names and texts that the user sees.
struct Constraint {
  RejectionReason reason;
  std::string_view config_section;  ///< section of the config that contains the key of the limit
  /// key of the limit in `config_section`; casting.json and logs use this name, too
  std::string_view config_key;
  /// the option that holds the limit, if it is a diversity option
  double DiversityOptions::*diversity_limit = nullptr;
  /// the option that holds the limit, if it is a believability option
  double BelievabilityOptions::*believability_limit = nullptr;
  /// unit of the limit, with a space before it
  std::string_view unit = {};
  /// text about a face that violates the constraint; messages append the limit
  std::string_view violation_text = {};
  /// What users can change if too few faces meet the constraint. The most promising change comes
  /// first.
  std::span<const std::string_view> advice;

  /// Returns whether the limit is a minimum distance. If so, a lower limit lets more faces fit.
  bool is_distance() const { return diversity_limit != nullptr && unit == " mm"; }
};
const Constraint& constraint_of(RejectionReason reason);

/// Returns the name of the constraint whose violation is `reason`: the key of the constraint in the
/// config.
inline std::string_view name_of(RejectionReason reason) {
  return constraint_of(reason).config_key;
}
/// Returns a text such as "diversity.min_distance, 0.8 mm".
std::string describe(RejectionReason reason, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability);
/// Returns a text such as "nearer to a head than the limit, 0.5 mm".
///
/// \pre `reason` is not kFamily, kRejected or kTraits.
std::string describe_violation(RejectionReason reason, const DiversityOptions& diversity,
                               const BelievabilityOptions& believability);

/// Number of rejected candidates for each reason.
struct RejectionCounts {
  /// number of rejected candidates for each RejectionReason
  std::array<std::uint64_t, kReasonCount> counts = {};
  void add(RejectionReason reason, std::uint64_t candidate_count = 1) {
    counts[static_cast<std::size_t>(reason)] += candidate_count;
  }
  void add(const RejectionCounts& other) {
    for (std::size_t r = 0; r < kReasonCount; ++r) counts[r] += other.counts[r];
  }
  std::uint64_t of(RejectionReason reason) const {
    return counts[static_cast<std::size_t>(reason)];
  }
  std::uint64_t total() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  }
  /// Returns the most frequent reason; if several reasons are equally frequent, the first of these
  /// in the enumeration.
  RejectionReason most_frequent() const {
    return static_cast<RejectionReason>(std::ranges::max_element(counts) - counts.begin());
  }
};

}  // namespace crowdface
