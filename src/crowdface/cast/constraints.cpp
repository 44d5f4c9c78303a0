// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/constraints.h"

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Advice = std::string_view;

constexpr Advice kRoom[] = {"more heads, or regions that are blended separately",
                            "a wider range of smoothness, or a smaller pull"};
constexpr Advice kMixture[] = {
    "a larger pull or distribution: uniform, which mix more heads into a face",
    "another range of smoothness"};
constexpr Advice kShape[] = {"extrapolation nearer to 1", "a larger limit under believability"};
constexpr Advice kFamilies[] = {
    "another max_distance or min_distance of the family, fewer members or families",
    "more heads, so that families have more room between them"};
constexpr Advice kTraits[] = {"wider limits, or heads that reach farther",
                              "extrapolation above 1, which exaggerates the details of heads"};
constexpr Advice kReview[] = {"a smaller min_distance_to_rejected"};

using Diversity = DiversityOptions;
using Believability = BelievabilityOptions;

constexpr std::array<Constraint, kReasonCount> kConstraints = {{
    {RejectionReason::kMinDistance, "diversity", "min_distance", &Diversity::min_distance_mm,
     nullptr, " mm", "nearer to another face than", kRoom},
    {RejectionReason::kMinDistanceToHeads, "diversity", "min_distance_to_faces",
     &Diversity::min_distance_to_heads_mm, nullptr, " mm", "nearer to a head than", kMixture},
    {RejectionReason::kMaxWeight, "diversity", "max_weight", &Diversity::max_weight, nullptr, "",
     "one head has more weight in a region than", kMixture},
    {RejectionReason::kImplausible, "believability", "max_deviation", nullptr,
     &Believability::max_deviation, "", "farther from the heads' mean than", kShape},
    {RejectionReason::kFlipped, "believability", "max_flipped", nullptr,
     &Believability::max_flipped, "", "more of the skin is turned over than", kShape},
    {RejectionReason::kStretched, "believability", "max_stretch", nullptr,
     &Believability::max_stretch, "", "skin is stretched more than", kShape},
    {RejectionReason::kIntersecting, "believability", "max_intersecting", nullptr,
     &Believability::max_intersecting, "", "more of the skin passes through other skin than",
     kShape},
    {RejectionReason::kGap, "believability", "max_gap", nullptr, &Believability::max_gap_mm, " mm",
     "lips, or other skin that nearly touches, part by more than", kShape},
    {RejectionReason::kExposed, "believability", "max_exposed", nullptr,
     &Believability::max_exposed_mm2, " mm²",
     "the lining of nose, lips or lids shows through the skin by more than", kShape},
    {.reason = RejectionReason::kFamily,
     .config_section = "",
     .config_key = "family",
     .advice = kFamilies},
    {.reason = RejectionReason::kRejected,
     .config_section = "diversity",
     .config_key = "min_distance_to_rejected",
     .advice = kReview},
    {.reason = RejectionReason::kTraits,
     .config_section = "",
     .config_key = "traits",
     .advice = kTraits},
}};

constexpr bool constraints_are_in_order() {
  for (std::size_t r = 0; r < kReasonCount; ++r) {
    if (kConstraints[r].reason != static_cast<RejectionReason>(r)) return false;
  }
  return true;
}
static_assert(constraints_are_in_order(),
              "every RejectionReason has its row, in the enumeration's order");

std::string full_key(const Constraint& constraint) {
  return concat(constraint.config_section, '.', constraint.config_key);
}

/// Returns the value of a constraint's limit with its unit, as text.
std::string limit_of(const Constraint& constraint, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability) {
  const double limit = constraint.diversity_limit != nullptr
                           ? diversity.*constraint.diversity_limit
                           : believability.*constraint.believability_limit;
  return concat(limit, constraint.unit);
}

}  // namespace

const Constraint& constraint_of(RejectionReason reason) {
  return kConstraints[static_cast<std::size_t>(reason)];
}

std::string describe(RejectionReason reason, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability) {
  if (reason == RejectionReason::kFamily) return "the distances within the family";
  if (reason == RejectionReason::kTraits) return "the limits on measurements (traits)";
  const Constraint& constraint = constraint_of(reason);
  if (reason == RejectionReason::kRejected) {
    return concat("the distance to faces that reviews rejected (", full_key(constraint), ")");
  }
  if (reason == RejectionReason::kMinDistanceToHeads && diversity.min_distance_to_heads_mm == 0) {
    return concat("the rule that no face looks like a head (", full_key(constraint),
                  " is not set)");
  }
  return concat(full_key(constraint), ", ", limit_of(constraint, diversity, believability));
}

std::string describe_violation(RejectionReason reason, const DiversityOptions& diversity,
                               const BelievabilityOptions& believability) {
  const Constraint& constraint = constraint_of(reason);
  return concat(constraint.violation_text, " the limit, ",
                limit_of(constraint, diversity, believability));
}

}  // namespace crowdface
