// SPDX-License-Identifier: Apache-2.0
// The constraints on faces: a table with the key, limit and advice of each.
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
enum class Reason {
  kMinDistance,         ///< too near to another face of the crowd
  kMinDistanceToFaces,  ///< too near to an input head
  kMaxWeight,           ///< one head has too much weight in a region
  kImplausible,         ///< too far from the mean of the heads to be believable
  kFlipped,             ///< part of the skin is turned inside out or collapsed
  kStretched,           ///< part of the skin is stretched too far
  kIntersecting,        ///< the skin intersects itself where the target's does not
  kGap,                 ///< the gap between lips (or similar skin) is wider than in any head
  kExposed,             ///< the back side of the skin is visible near an intersection
  kFamily,              ///< intrudes into another family, or breaks a limit of its own family
  kRejected,            ///< too similar to a face that a review rejected
  kTraits,              ///< a measurement is outside its limits
};
constexpr auto kReasonCount = static_cast<std::size_t>(Reason::kTraits) + 1;

/// A constraint as the user sees it.
struct Constraint {
  Reason reason;
  std::string_view section;  ///< section of the config
  std::string_view key;      ///< key in this section; also the name in casting.json and logs
  /// the limit, if it is a diversity option
  double DiversityOptions::*diversity = nullptr;
  /// the limit, if it is a believability option
  double BelievabilityOptions::*believability = nullptr;
  /// unit of the limit, after a space
  std::string_view unit = {};
  /// text about a face that violates the constraint; messages put the limit after it
  std::string_view violation_text = {};
  /// What users can change if too few faces meet the constraint; most promising first.
  std::span<const std::string_view> advice;

  /// Returns whether the limit is a distance, so that more faces satisfy a smaller limit.
  bool is_distance() const { return diversity != nullptr && unit == " mm"; }
};
const Constraint& constraint_of(Reason reason);

/// Returns the constraint's key in the config.
inline std::string_view name_of(Reason reason) {
  return constraint_of(reason).key;
}
/// Returns, for example, "diversity.min_distance, 0.8 mm".
std::string describe(Reason reason, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability);
/// Returns, for example, "nearer to a head than the limit, 0.5 mm".
///
/// \pre `reason` is none of kFamily, kRejected and kTraits.
std::string describe_violation(Reason reason, const DiversityOptions& diversity,
                               const BelievabilityOptions& believability);

/// Number of rejected candidates by reason.
struct Rejections {
  std::array<std::uint64_t, kReasonCount> count = {};
  void add(Reason reason, std::uint64_t times = 1) {
    count[static_cast<std::size_t>(reason)] += times;
  }
  void add(const Rejections& other) {
    for (std::size_t r = 0; r < kReasonCount; ++r) count[r] += other.count[r];
  }
  std::uint64_t of(Reason reason) const { return count[static_cast<std::size_t>(reason)]; }
  std::uint64_t total() const {
    return std::accumulate(count.begin(), count.end(), std::uint64_t{0});
  }
  /// Returns the most frequent reason; if several are equally frequent, the first of them.
  Reason most_frequent() const {
    return static_cast<Reason>(std::ranges::max_element(count) - count.begin());
  }
};

}  // namespace crowdface
