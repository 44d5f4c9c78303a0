// SPDX-License-Identifier: Apache-2.0
// What a face must keep to: one row for each constraint, with its key, its limit, and what helps where it cannot be met.
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

/// Why a candidate was thrown away: the constraint that it breaks.
enum class Reason {
  kMinDistance,         ///< too near to another face of the crowd
  kMinDistanceToFaces,  ///< too near to an input head
  kMaxWeight,           ///< one head has too much weight
  kImplausible,         ///< farther from the heads' mean than believable
  kFlipped,             ///< a part of the skin turned inside out or collapsed
  kStretched,           ///< a part of the skin stretched too far
  kIntersecting,        ///< the skin passes through itself where the target's does not
  kGap,                 ///< skin that nearly touches in the heads parts farther than in any
  kExposed,             ///< skin shows its back where it passes through other skin
  kFamily,              ///< among another family, or too far from its own
  kRejected,            ///< too like the face that a review rejected
};
constexpr auto kReasonCount = static_cast<std::size_t>(Reason::kRejected) + 1;

/// A constraint, as the user knows it.
struct Constraint {
  Reason reason;
  std::string_view section;  ///< of the config
  std::string_view key;      ///< in that section; also the name in casting.json and logs
  double DiversityOptions::*diversity = nullptr;          ///< the limit, if it stands there
  double BelievabilityOptions::*believability = nullptr;  ///< or there
  std::string_view unit = {};                             ///< of the limit, with a space before it
  std::string_view broken = {};  ///< what is wrong with a face that breaks it; the key follows
  /// What a user can change where too few faces meet it, most promising first.
  std::span<const std::string_view> advice;

  /// Whether a smaller limit fits more faces.
  bool is_distance() const { return diversity != nullptr && unit == " mm"; }
};
const Constraint& constraint_of(Reason reason);

/// The config key of the constraint.
inline std::string_view name_of(Reason reason) {
  return constraint_of(reason).key;
}
/// "diversity.min_distance, 0.8 mm".
std::string describe(Reason reason, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability);
/// "nearer to a head than diversity.min_distance_to_faces (0.5 mm)".
std::string describe_broken(Reason reason, const DiversityOptions& diversity,
                            const BelievabilityOptions& believability);

/// How many candidates were thrown away, by reason.
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
  /// The reason with most rejections, of equals the first.
  Reason most_frequent() const {
    return static_cast<Reason>(std::ranges::max_element(count) - count.begin());
  }
};

}  // namespace crowdface
