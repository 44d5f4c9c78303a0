// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/trait_rules.h"

#include <algorithm>

namespace crowdface {
namespace {

bool limits_faces(const TraitLimits& limits) {
  return std::ranges::any_of(
      limits, [](const TraitLimit& limit) { return limit.at_least || limit.at_most; });
}

}  // namespace

TraitLimits TraitRules::limits_of(const FacePlan& face) const {
  if (face.family) {
    const auto family = std::ranges::find(casting_->families, *face.family, &FamilyOptions::name);
    if (family == casting_->families.end()) return {};
    const SamplingOptions& common =
        family->group ? casting_->groups[*family->group].sampling : casting_->sampling;
    return merge_limits(common.traits, family->traits);
  }
  if (!face.group && !face.index) {
    if (face.id.empty()) return {};
    const auto hand = std::ranges::find(casting_->recipes, face.id, &ManualRecipe::id);
    if (hand != casting_->recipes.end()) return hand->traits;
  }
  return sampling_of(*casting_, face.group).traits;
}

std::optional<RejectionReason> TraitRules::check(const FacePlan& face,
                                                 const Positions& landmarks) const {
  if (measurer_->meets(limits_of(face), landmarks)) return std::nullopt;
  return RejectionReason::kTraits;
}

std::uint32_t max_attempts_factor(const CastingOptions& casting) {
  return has_trait_limits(casting) ? kAttemptFactorWithTraits : 1;
}

bool has_trait_limits(const CastingOptions& casting) {
  const auto of_sampling = [](const auto& of) { return limits_faces(of.sampling.traits); };
  const auto own = [](const auto& of) { return limits_faces(of.traits); };
  return of_sampling(casting) || std::ranges::any_of(casting.groups, of_sampling) ||
         std::ranges::any_of(casting.families, own) || std::ranges::any_of(casting.recipes, own);
}

}  // namespace crowdface
