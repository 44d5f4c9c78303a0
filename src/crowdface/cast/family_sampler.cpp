// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/family_sampler.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "crowdface/cast/ageing.h"
#include "crowdface/cast/band_order.h"
#include "crowdface/cast/face_ids.h"
#include "crowdface/cast/mixed_recipe.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// smallest distance of a member from the founder, as a fraction of max_distance
constexpr double kMinDistanceFraction = 0.4;
/// A member is a mixture of the founder and a random face. If the family has parents, each band of
/// detail of this random face is a mixture too: the detail of the mother or the father has this
/// weight, and random detail has the remaining weight.
constexpr double kParentShare = 0.75;
/// If the member is a child of two parents, the coarse shape of the random face is a mixture of one
/// parent's coarse shape (with the weight kMainParentShapeShare), a random coarse shape
/// (kRandomShapeShare) and the other parent's coarse shape (the remaining weight). Without the
/// random coarse shape, siblings would hardly differ.
constexpr double kMainParentShapeShare = 0.65;
constexpr double kRandomShapeShare = 0.2;
constexpr int kHalvings = 10;
// largest distance in mm between a twin and the hidden child from which all twins are derived
constexpr double kMaxTwinDistanceMm = 0.5;

/// A child counts as resembling a parent if at most this fraction of strangers is nearer to the
/// child than the parent is.
constexpr double kMaxFractionOfNearerStrangersForChild = 0.1;
/// Limit for children whose two parents are far apart from each other: a child's distance from a
/// parent is at most the distance of the family's founder from this parent, plus this fraction of
/// max_distance.
constexpr double kMaxFartherThanFounder = 0.25;

/// Returns the distribution from which casting draws a new parent: the distribution of the parent's
/// group or of the crowd, but with only those targets that have the parent's sex
/// (Parent::possible_target_heads). If there are no such targets, keeps all targets of the
/// distribution.
FaceDistribution distribution_of_parent(const Parent& parent, const CastingOptions& casting) {
  FaceDistribution kind = distribution_of_group(casting, parent.group);
  std::vector<WeightedHead> own;
  for (const WeightedHead& target : kind.targets) {
    if (contains(parent.possible_target_heads, target.head)) own.push_back(target);
  }
  if (!own.empty()) kind.targets = std::move(own);
  return kind;
}

}  // namespace

FamilySampler::FamilySampler(const CastingOptions& casting, const FamilyOptions& family,
                             const FaceJudge& judge, const UnrelatedFaces& unrelated,
                             const CrowdSoFar& crowd)
    : casting_(casting),
      family_(family),
      judge_(judge),
      unrelated_faces_(unrelated),
      parents_(family.parents.size()),
      relative_points_(judge.space().dimensions()),
      stranger_points_(judge.space().dimensions()) {
  const auto& faces = crowd.faces();
  for (std::size_t p = 0; p < parents_.size(); ++p) {
    const Parent& parent = family.parents[p];
    if (parent.head) {
      FacePlan face;
      face.recipe.target = *parent.head;
      add_parent(p, parent.id, std::move(face), judge.space().head_point(*parent.head));
      continue;
    }
    const auto found = std::find_if(faces.begin(), faces.end(), [&](const FacePlan& face) {
      return face.id == parent.id || face.id == parent_id(casting.name, parent);
    });
    if (found == faces.end()) {
      if (!parent.is_new) {
        throw InvalidInput(
            concat("family ", family.name, ": no earlier face is called ", quoted(parent.id)));
      }
      parents_not_in_crowd_.push_back(p);
      continue;
    }
    add_parent(p, found->id, *found,
               crowd.points()[static_cast<std::size_t>(found - faces.begin())]);
    if (found->family) relative_family_names_.push_back(*found->family);
  }
  if (parents_not_in_crowd_.empty()) prepare_inheritance();
  const auto is_parent = [&](const std::string& name) {
    return std::any_of(parents_.begin(), parents_.end(),
                       [&](const KnownParent& one) { return !name.empty() && one.name == name; });
  };
  for (const FacePlan& face : faces) {
    if (face.family && std::any_of(face.parents.begin(), face.parents.end(), is_parent)) {
      relative_family_names_.push_back(*face.family);
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const FacePlan& face = faces[i];
    const bool relative = face.family && contains(relative_family_names_, *face.family);
    (relative || is_parent(face.id) ? relative_points_ : stranger_points_).add(crowd.points()[i]);
  }
}

void FamilySampler::add_parent(std::size_t parent, std::string name, FacePlan face,
                               FaceSpace::Point point) {
  undo_age(face, casting_);  // children do not inherit their parents' age
  parents_[parent] = {std::move(name), std::move(face), std::move(point)};
}

void FamilySampler::prepare_inheritance() {
  third_contributor_distribution_ = third_contributor_distribution();
  if (!family_.group || parents_.empty()) return;
  const FaceDistribution kind = distribution_of_group(casting_, family_.group);
  std::vector<Index> taken, targets;
  for (const KnownParent& parent : parents_) {
    for (const SourceWeight& share : target_head_weights(parent.face.recipe)) {
      taken.push_back(share.head);
    }
  }
  for (const WeightedHead& target : kind.targets) targets.push_back(target.head);
  // Replace the parents' targets by targets of the group only if the group has several targets. If
  // it has only one, all children would get the shape of this one target.
  target_substitutes_ = targets.size() > 1
                            ? SubstituteHeads(targets, casting_.tags, taken, judge_.space())
                            : SubstituteHeads();
  source_substitutes_.clear();
  for (std::size_t b = 0; b < band_count(*kind.sampling); ++b) {
    source_substitutes_.emplace_back(sources_of(kind, b), casting_.tags, taken, judge_.space());
  }
}

std::vector<SourceWeight> FamilySampler::coarse_shape_of(std::size_t parent) const {
  return target_substitutes_.substituted(target_head_weights(parents_[parent].face.recipe));
}

FaceDistribution FamilySampler::third_contributor_distribution() const {
  constexpr std::size_t kMin = 3;
  FaceDistribution kind = distribution_of_group(casting_, family_.group);
  if (parents_.empty() || casting_.tags.empty()) return kind;
  const auto tags_of = [&](std::size_t parent) {
    const Index head = typical_head(parents_[parent].face.recipe, casting_.tags);
    return casting_.tags[static_cast<std::size_t>(head)];
  };
  std::vector<std::string> both = tags_of(0);
  std::erase_if(both, [father = tags_of(1)](const auto& tag) { return !contains(father, tag); });
  const auto likest = [&](auto& heads, const auto& head_of) {
    std::vector<std::size_t> common;
    for (const auto& one : heads) {
      common.push_back(
          common_tag_count(both, casting_.tags[static_cast<std::size_t>(head_of(one))]));
    }
    std::vector<std::size_t> sorted = common;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    const std::size_t least = sorted[std::min(kMin, sorted.size()) - 1];
    std::size_t i = 0;
    std::erase_if(heads, [&](const auto&) { return common[i++] < least; });
  };
  likest(kind.targets, [](const WeightedHead& target) { return target.head; });
  for (std::size_t b = 0; b < band_count(*kind.sampling); ++b) {
    kind.sources.push_back(sources_of(*kind.sampling, b));
    likest(kind.sources.back(), [](Index head) { return head; });
  }
  return kind;
}

bool FamilySampler::sample_parents(const CrowdSoFar& crowd,
                                   const FamilySeparation& family_separation, std::uint32_t attempt,
                                   RejectionCounts& rejections) {
  new_parents_.clear();
  for (const std::size_t p : parents_not_in_crowd_) {
    const Parent& parent = family_.parents[p];
    ManualRecipe open;
    open.id = parent_id(casting_.name, parent);
    const FaceDistribution kind = distribution_of_parent(parent, casting_);
    FaceSearch search(
        [&](std::uint32_t draw) {
          return random_face_plan(casting_, open, {0, draw, concat("parent/", parent.id)}, kind);
        },
        judge_, casting_.diversity, 1,
        attempt * static_cast<std::uint32_t>(casting_.diversity.max_attempts) *
            max_attempts_factor(casting_));
    auto found = search.choose_face(
        crowd, [&](const FaceSpace::Point& point) -> std::optional<RejectionReason> {
          if (distance_to_new_parent_mm(point) < casting_.diversity.min_distance_mm)
            return RejectionReason::kMinDistance;
          return family_separation.rejection_reason(point);
        });
    rejections.add(search.rejections());
    if (!found) return false;
    add_parent(p, found->face.id, found->face, found->point);
    new_parents_.push_back(std::move(*found));
  }
  prepare_inheritance();
  return true;
}

double FamilySampler::distance_to_new_parent_mm(const FaceSpace::Point& point) const {
  double mm = HUGE_VAL;
  for (const FaceSearch::FoundFace& parent : new_parents_) {
    mm = std::min(mm, FaceSpace::distance(point, parent.point));
  }
  return mm;
}

BandRecipe FamilySampler::parent_band(std::size_t parent, std::size_t region, std::size_t band,
                                      const BandRecipe& random_band) const {
  BandRecipe own = random_band;
  if (family_.parents[parent].head) {
    own.position.reset();
    own.weights = {{*family_.parents[parent].head, 1}};
  } else {
    own = band_of(parents_[parent].face.recipe.regions[region], band);
  }
  if (source_substitutes_.empty() || source_substitutes_[band].contains_all(own.weights))
    return own;
  own.position.reset();
  own.weights = source_substitutes_[band].substituted(own.weights);
  return own;
}

FacePlan FamilySampler::founder(std::uint32_t attempt) const {
  ManualRecipe open;
  open.target = family_.target;
  open.age = AgeRange{};
  FacePlan face = random_face_plan(casting_, open, {0, attempt, concat("family/", family_.name)},
                                   third_contributor_distribution_);
  if (parents_.empty()) {
    // mark the face as a member, so that the family's limits on measurements apply
    face.family = family_.name;
    return face;
  }
  if (!family_.target) {
    set_target_heads(face.recipe, mixed_weights(coarse_shape_of(0), coarse_shape_of(1), 0.5));
    face.mother_share = 0.5;
  }
  const Recipe& mother = parents_[0].face.recipe;
  const Recipe& father = parents_[1].face.recipe;
  face.recipe.asymmetry = mixed(mother.asymmetry, father.asymmetry, 0.5);
  face.recipe.mirrored = mother.mirrored;
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    RegionRecipe& region = face.recipe.regions[k];
    for (std::size_t b = 0; b < band_count(region); ++b) {
      BandRecipe& band = band_of(region, b);
      const int from = parent_to_inherit_from(k, b);
      band = from >= 0 ? parent_band(static_cast<std::size_t>(from), k, b, band)
                       : mixed(parent_band(0, k, b, band), parent_band(1, k, b, band), 0.5,
                               casting_.level_scale);
    }
    restore_level_order(region);
  }
  return face;
}

FacePlan FamilySampler::mixed_face(const FacePlan& from, const MemberDraft& draft, double t) const {
  FacePlan face = draft.random_face;
  face.recipe = mixed(from.recipe, draft.random_face.recipe, t, casting_.level_scale);
  face.mother_share = (1 - t) * from.mother_share + t * draft.random_face.mother_share;
  apply_age(face, draft.age, casting_);
  if (draft.age_years_of_twins) face.age_years = draft.age_years_of_twins;
  return face;
}

int FamilySampler::parent_to_inherit_from(std::size_t region, std::size_t band) const {
  return family_.parent_of_band[region * band_count(casting_.sampling) + band];
}

void FamilySampler::inherit_from_parents(FacePlan& face, const FaceRandomKey& key) const {
  const auto parent_of = [&](const std::string& what) -> std::size_t {
    const std::string purpose = concat(key.purpose_prefix, "/inherits/", what);
    return random_uniform({casting_.seed, key.index, purpose, key.attempt}) < 0.5 ? 0 : 1;
  };
  if (!family_.target) {
    const double one = kMainParentShapeShare / (1 - kRandomShapeShare);
    const double mother = parent_of("large forms") == 0 ? one : 1 - one;
    const auto of_parents = mixed_weights(coarse_shape_of(0), coarse_shape_of(1), 1 - mother);
    set_target_heads(face.recipe, mixed_weights(of_parents, target_head_weights(face.recipe),
                                                kRandomShapeShare));
    face.mother_share = mother * (1 - kRandomShapeShare);
  }
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    RegionRecipe& region = face.recipe.regions[k];
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const int from = parent_to_inherit_from(k, b);
      const std::string& name = casting_.region_names[k];
      const std::size_t parent =
          from >= 0 ? static_cast<std::size_t>(from)
                    : parent_of(b == 0 ? name : concat(name, '/', casting_.sampling.bands[b].name));
      BandRecipe& band = band_of(region, b);
      band = mixed(band, parent_band(parent, k, b, band), kParentShare, casting_.level_scale);
      face.inherited_from.emplace_back(parent == 0 ? "mother" : "father");
    }
    restore_level_order(region);
  }
  for (const KnownParent& parent : parents_) face.parents.push_back(parent.name);
}

double FamilySampler::max_distance_from_founder_mm(const FamilyPlan& family_plan) const {
  const double most = family_.max_distance_mm;
  return family_plan.founder_is_prototype_of_twins ? std::min(most, kMaxTwinDistanceMm) : most;
}

FamilySampler::MemberDraft FamilySampler::member_draft(const FamilyPlan& family_plan, int member,
                                                       std::uint32_t attempt) const {
  const FaceRandomKey key = {static_cast<std::uint64_t>(member), attempt,
                             concat("family/", family_.name)};
  ManualRecipe open;
  open.id = member_id(casting_.name, family_.name, member);
  open.target = family_.target;
  if (parents_.empty()) open.target = family_plan.founder.recipe.target;
  open.age = AgeRange{};
  MemberDraft draft;
  draft.random_face = random_face_plan(casting_, open, key, third_contributor_distribution_);
  draft.random_face.family = family_.name;
  if (!parents_.empty()) inherit_from_parents(draft.random_face, key);
  const std::string purpose = concat(key.purpose_prefix, "/how");
  const auto [how_far, how_old] = random_pair({casting_.seed, key.index, purpose, attempt});
  const Range& ages = family_.age.range;
  draft.age = {ages.low + (ages.high - ages.low) * how_old, family_.age.unit};
  // `how_far` ranges from 0 (smallest distance from the founder) to 1 (largest distance)
  draft.distance_mm = (kMinDistanceFraction + (1 - kMinDistanceFraction) * how_far) *
                      max_distance_from_founder_mm(family_plan);
  if (family_plan.founder_is_prototype_of_twins) {
    draft.random_face.inherited_from = family_plan.founder.inherited_from;
    draft.age = {family_plan.founder.age.value_or(0)};
    draft.age_years_of_twins = family_plan.founder.age_years;
  }
  return draft;
}

FacePlan FamilySampler::face_at_chosen_distance(const FamilyPlan& family_plan,
                                                const MemberDraft& draft) const {
  const auto beyond = [&](const FacePlan& face) {
    return FaceSpace::distance(judge_.space().point(face.recipe), family_plan.founder_point) >
           draft.distance_mm;
  };
  // Mix the founder and the random face. Find by bisection the share `t` of the random face with
  // which the mixture has the chosen distance from the founder.
  double t = 1, step = 0.5;
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    const bool too_far = beyond(mixed_face(family_plan.founder, draft, t));
    if (t == 1 && !too_far) break;
    t += too_far ? -step : step;
  }
  // The face that the bisection found may lie beyond the chosen distance. If so, go back by the
  // bisection's last step.
  FacePlan face = mixed_face(family_plan.founder, draft, t);
  if (t > step && beyond(face))
    face = mixed_face(family_plan.founder, draft, std::max(t - 2 * step, 0.0));
  return face;
}

FacePlan FamilySampler::twins_prototype(const FamilyPlan& family_plan,
                                        std::uint32_t attempt) const {
  MemberDraft model = member_draft(family_plan, 0, attempt);
  const Age age = std::exchange(model.age, Age{});
  FacePlan face = face_at_chosen_distance(family_plan, model);
  face.age = age_as_fraction(age, face, casting_);
  if (age.unit == AgeUnit::kYears) face.age_years = age.value;
  return face;
}

FacePlan FamilySampler::member(const FamilyPlan& family_plan, int member,
                               std::uint32_t attempt) const {
  return face_at_chosen_distance(family_plan, member_draft(family_plan, member, attempt));
}

std::optional<RejectionReason> FamilySampler::rejection_reason(
    const FamilyPlan& family_plan, const FaceSpace::Point& point,
    const std::vector<FaceSpace::Point>& members, const FamilySeparation& family_separation) const {
  if (FaceSpace::distance(point, family_plan.founder_point) >
      max_distance_from_founder_mm(family_plan))
    return RejectionReason::kFamily;
  if (family_separation.is_too_near_to_family(point, relative_family_names_))
    return RejectionReason::kFamily;
  if (!resembles_parents(family_plan, point)) return RejectionReason::kFamily;
  if (relative_points_.nearest(point, family_.min_distance_mm).face >= 0)
    return RejectionReason::kFamily;
  if (distance_to_new_parent_mm(point) < family_.min_distance_mm) return RejectionReason::kFamily;
  double farthest = 0;
  for (const FaceSpace::Point& relative : members) {
    const double mm = FaceSpace::distance(point, relative);
    if (mm < family_.min_distance_mm) return RejectionReason::kFamily;
    farthest = std::max(farthest, mm);
    // The earlier member `relative` must also be nearer to `point` than to any stranger.
    if (stranger_points_.nearest(relative).distance_mm <= mm) return RejectionReason::kFamily;
  }
  if (stranger_points_.nearest(point).distance_mm <= farthest) return RejectionReason::kFamily;
  return std::nullopt;
}

bool FamilySampler::resembles_parents(const FamilyPlan& family_plan,
                                      const FaceSpace::Point& point) const {
  if (fraction_of_strangers_nearer_than_parent(point) <= kMaxFractionOfNearerStrangersForChild)
    return true;
  if (fraction_of_strangers_nearer_than_parent(family_plan.founder_point) <=
      kMaxFractionOfNearerStrangersForFounder)
    return false;
  return std::all_of(parents_.begin(), parents_.end(), [&](const KnownParent& parent) {
    return FaceSpace::distance(point, parent.point) <=
           FaceSpace::distance(family_plan.founder_point, parent.point) +
               kMaxFartherThanFounder * family_.max_distance_mm;
  });
}

double FamilySampler::fraction_of_strangers_nearer_than_parent(
    const FaceSpace::Point& point) const {
  double share = 0;
  for (const KnownParent& parent : parents_) {
    if (!target_substitutes_.contains_all(target_head_weights(parent.face.recipe))) continue;
    const double mm = FaceSpace::distance(point, parent.point);
    share = std::max(share, unrelated_faces_.fraction_nearer(point, mm, family_.group));
  }
  return share;
}

}  // namespace crowdface
