// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_changes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "crowdface/cast/ageing.h"
#include "crowdface/cast/band_order.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/mixed_recipe.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// How much `older` and `younger` change an age, which ranges from −1 to 1.
constexpr double kAgeStep = 0.5;

std::size_t face_called(const std::string& id, const CastingResult& cast) {
  const auto found = std::ranges::find(cast.crowd, id, &FacePlan::id);
  if (found == cast.crowd.end()) {
    throw InvalidInput(concat("a change names ", quoted(id), ", which is not in the crowd"));
  }
  return static_cast<std::size_t>(found - cast.crowd.begin());
}

/// Returns a copy of a face with all changes applied so far.
std::shared_ptr<const ChangedFace> current(std::size_t face, const CastingResult& cast) {
  const auto changed = cast.changed.find(face);
  return std::make_shared<const ChangedFace>(changed == cast.changed.end()
                                                 ? ChangedFace{cast.crowd[face], cast.points[face]}
                                                 : changed->second);
}

FaceDistribution distribution_of_named_group(const std::optional<std::string>& group,
                                             const CastingOptions& casting) {
  if (!group) return distribution_of_group(casting);
  const auto found = std::ranges::find(casting.groups, *group, &Group::name);
  return distribution_of_group(casting, static_cast<std::size_t>(found - casting.groups.begin()));
}

/// Returns the names of the config keys that a change sets.
std::vector<std::string> changed_keys(const AppliedChange& applied) {
  const FaceChange& change = applied.change;
  const std::pair<const char*, bool> keys[] = {{"age", change.age || change.age_step},
                                               {"variant_of", change.variant_of.has_value()},
                                               {"group", change.group.has_value()},
                                               {"lock", !change.locked_bands.empty()},
                                               {"traits", !change.traits.empty()},
                                               {"wears", change.attachments.has_value()},
                                               {"takes_off", !change.removed_attachments.empty()},
                                               {"hair", change.hair.has_value()},
                                               {"colours", !change.colours.empty()}};
  std::vector<std::string> names;
  for (const auto& [name, is_there] : keys) {
    if (is_there) names.emplace_back(name);
  }
  return names;
}

/// Returns the smallest fraction at which a condition holds, to the accuracy of the bisection.
///
/// \pre The condition holds at 1.
template <class Holds>
double smallest_fraction_where(const Holds& holds) {
  constexpr int kSteps = 10;  // the bisection finds the fraction to within 0.1 %
  double share = 1, step = 0.5;
  for (int i = 0; i < kSteps; ++i, step *= 0.5) {
    if (holds(share - step)) share -= step;
  }
  return share;
}

/// Returns whether a redraw is needed only to meet limits on measurements: the change sets neither
/// a group nor locked bands.
bool redraws_only_for_limits(const FaceChange& change) {
  return !change.group && change.locked_bands.empty();
}

class FaceChanger {
 public:
  FaceChanger(const CastingOptions& casting, const FaceJudge& judge, std::size_t at,
              CastingResult& cast)
      : casting_(casting), judge_(judge), at_(at), cast_(cast), changed_(cast.changed.at(at)) {}

  /// Starts from the face as it was cast, and applies all changes of this face.
  void apply() {
    changed_.face = cast_.crowd[at_];
    changed_.is_other_person = false;
    changed_.traits.clear();
    for (const AppliedChange& change : changed_.changes) {
      if (cast_.shortfall) return;
      ++number_;
      apply(change);
      changed_.face.notes.changes.push_back(
          concat(change.origin, ": ", join(changed_keys(change))));
    }
    changed_.point = judge_.space().point(changed_.face.recipe);
    std::vector<bool> is_before(cast_.crowd.size());
    std::fill_n(is_before.begin(), at_, true);
    changed_.face.notes.nearest = nearest_neighbours(judge_, cast_, changed_.point, is_before);
  }

 private:
  void apply(const AppliedChange& applied) {
    const FaceChange& change = applied.change;
    min_distance_mm_ = applied.min_distance_mm;
    changed_.traits = merge_limits(changed_.traits, change.traits);
    if (applied.variant_of) {
      changed_.variant_of = applied.variant_of;
      change_into(search(vary(change), CrowdSoFar(judge_.space().dimensions())));
    } else if (change.needs_redraw() &&
               !(redraws_only_for_limits(change) && meets_limits(changed_.face))) {
      changed_.variant_of.reset();
      change_into(search(make_redraw(change), faces_before()));
    }
    if (change.age_step) {
      const double step = *change.age_step == FaceChange::AgeStep::kOlder ? kAgeStep : -kAgeStep;
      set_age({std::clamp(changed_.face.age.value_or(0) + step, -1.0, 1.0)});
    }
    if (change.age) set_age(*change.age);
  }

  /// Returns the key of the random numbers, which differ for each change and for each redraw of the
  /// face.
  FaceRandomKey key(std::uint32_t attempt) const {
    const FacePlan& original = cast_.crowd[at_];
    return {*original.index, attempt, concat("change/", number_, '/', original.notes.attempt)};
  }

  /// Returns the faces that precede the changed face in the plan, as they were before any review.
  CrowdSoFar faces_before() const {
    std::map<std::string, FaceSpace::Point> first;
    for (const FacePlan& face : cast_.rejected) {
      if (!first.contains(face.id)) first[face.id] = judge_.space().point(face.recipe);
    }
    CrowdSoFar faces(judge_.space().dimensions());
    for (std::size_t i = 0; i < at_; ++i) {
      const auto rejected = first.find(cast_.crowd[i].id);
      faces.add(cast_.crowd[i], rejected == first.end() ? cast_.points[i] : rejected->second);
    }
    return faces;
  }

  FaceSearch::GenerateCandidate vary(const FaceChange& change) const {
    FacePlan other = changed_.variant_of->face;
    const FaceSpace::Point point = judge_.space().point(other.recipe);
    const double age = other.age.value_or(0);
    undo_age(other, casting_);
    return [=, this](std::uint32_t attempt) {
      ManualRecipe open;
      open.id = changed_.face.id;
      open.target = other.recipe.target;
      open.age = AgeRange{};
      const FacePlan drawn = random_face_plan(casting_, open, key(attempt),
                                              distribution_of_named_group(other.group, casting_));
      const auto at = [&](double share) {
        FacePlan face = drawn;
        face.recipe = mixed(other.recipe, drawn.recipe, share, casting_.level_scale);
        face.recipe.colours = other.recipe.colours;
        face.age = other.age;
        if (!other.age) apply_age(face, {age}, casting_);
        face.age_years = other.age_years;
        return face;
      };
      const auto is_beyond = [&](const FacePlan& face) {
        return FaceSpace::distance(judge_.space().point(face.recipe), point) >=
               change.variant_distance_mm;
      };
      return at(is_beyond(at(1))
                    ? smallest_fraction_where([&](double share) { return is_beyond(at(share)); })
                    : 1);
    };
  }

  FaceSearch::GenerateCandidate make_redraw(const FaceChange& change) const {
    const FacePlan& now = changed_.face;
    FaceDistribution kind =
        distribution_of_named_group(change.group ? change.group : now.group, casting_);
    ManualRecipe open;
    open.id = now.id;
    if (!change.locked_bands.empty()) open.target = now.recipe.target;
    const Age age = now.age_years ? Age{*now.age_years, AgeUnit::kYears} : Age{now.age.value_or(0)};
    if (!change.group) open.age = AgeRange{{age.value, age.value}, age.unit};
    const bool only_traits = redraws_only_for_limits(change);
    return [=, this](std::uint32_t attempt) {
      FacePlan drawn = random_face_plan(casting_, open, key(attempt), kind);
      drawn.index = now.index;
      if (!change.locked_bands.empty())
        copy_locked_bands(change.locked_bands, now.recipe, drawn.recipe);
      if (!only_traits || !meets_limits(drawn)) return drawn;
      const auto at = [&](double share) {
        FacePlan face = drawn;
        face.recipe = mixed(now.recipe, drawn.recipe, share, casting_.level_scale);
        return face;
      };
      // Give the random face `drawn` a larger share of the mixture than `meets_limits` requires.
      // This margin is needed because `meets_limits` measures the face without building the whole
      // mesh.
      constexpr double kMargin = 0.05;
      const double share =
          smallest_fraction_where([&](double part) { return meets_limits(at(part)); });
      return at(share + kMargin * (1 - share));
    };
  }

  bool meets_limits(const FacePlan& face) const {
    const FaceMeasurer& measurer = judge_.trait_rules()->measurer();
    return measurer.meets(changed_.traits, measurer.landmarks(face.recipe));
  }

  std::optional<FaceSearch::FoundFace> search(const FaceSearch::GenerateCandidate& generate,
                                              const CrowdSoFar& others) {
    FaceJudge judge = judge_;
    CastingOptions limited;
    if (!changed_.traits.empty() && !changed_.variant_of) {
      limited.sampling.traits = merge_limits(casting_.sampling.traits, changed_.traits);
      limited.groups = casting_.groups;
      for (Group& group : limited.groups) {
        group.sampling.traits = merge_limits(group.sampling.traits, changed_.traits);
      }
      judge.set_trait_rules(TraitRules(judge.trait_rules()->measurer(), limited));
    } else if (changed_.variant_of) {
      judge.set_trait_rules(std::nullopt);
    }
    DiversityOptions diversity = casting_.diversity;
    diversity.min_distance_mm = min_distance_mm_;
    FaceSearch found(generate, judge, diversity, 1);
    auto face = found.choose_face(others);
    cast_.rejections.add(found.rejections());
    if (!face) {
      cast_.shortfall = Shortfall{casting_.count, found.rejections(), -1,
                                  Shortfall::What::kChangedFace, changed_.face.id};
    }
    return face;
  }

  void change_into(std::optional<FaceSearch::FoundFace> found) {
    if (!found) return;
    found->face.index = changed_.face.index;
    found->face.notes = changed_.face.notes;
    changed_.face = std::move(found->face);
    changed_.is_other_person = true;
  }

  void set_age(const Age& age) {
    undo_age(changed_.face, casting_);
    changed_.face.age.reset();
    apply_age(changed_.face, age, casting_);
  }

  const CastingOptions& casting_;
  const FaceJudge& judge_;
  std::size_t at_;
  CastingResult& cast_;
  ChangedFace& changed_;
  int number_ = 0;  ///< number of the current change, from 1
  /// smallest allowed distance between the changed face and other faces, for the current change
  double min_distance_mm_ = 0;
};

/// Applies changes to faces.
///
/// \param first  true: apply the new changes before a face's earlier changes; false: after a face's
///               earlier changes.
void apply(const CastingOptions& casting, const FaceJudge& judge,
           const std::vector<FaceChange>& changes, const std::string& origin, bool first,
           CastingResult& cast) {
  // A change can turn a face into a variant of another face, the original. Copy all originals
  // before any change is applied, because a change may alter an original.
  std::vector<AppliedChange> applied;
  for (const FaceChange& change : changes) {
    const std::optional<std::uint64_t> index = cast.crowd[face_called(change.id, cast)].index;
    applied.push_back({change, origin, nullptr,
                       first ? casting.diversity.min_distance_mm_of(index.value_or(0))
                             : casting.diversity.min_distance_mm});
    if (!change.variant_of) continue;
    applied.back().variant_of = current(face_called(*change.variant_of, cast), cast);
  }
  for (AppliedChange& one : applied) {
    if (cast.shortfall) return;
    const std::size_t at = face_called(one.change.id, cast);
    std::vector<AppliedChange>& own =
        cast.changed.try_emplace(at, ChangedFace{cast.crowd[at], cast.points[at]})
            .first->second.changes;
    own.insert(first ? own.begin() : own.end(), std::move(one));
    FaceChanger(casting, judge, at, cast).apply();
  }
}

}  // namespace

void apply_changes(const CastingOptions& casting, const FaceJudge& judge,
                   const std::vector<FaceChange>& changes, const std::string& origin,
                   CastingResult& cast) {
  apply(casting, judge, changes, origin, false, cast);
}

AvoidedFaces::AvoidedFaces(const CastingResult& cast, double min_distance_mm,
                           const std::vector<bool>& is_considered)
    : min_distance_mm_(min_distance_mm) {
  for (const auto& [face, changed] : cast.changed) {
    if (is_considered.empty() || is_considered[face]) points_.push_back(changed.point);
  }
}

NearestNeighbours nearest_neighbours(const FaceJudge& judge, const CastingResult& cast,
                                     const FaceSpace::Point& point,
                                     const std::vector<bool>& is_considered) {
  const auto [head, head_distance_mm] = judge.nearest_head(point);
  NearestNeighbours nearest{head, head_distance_mm, std::nullopt, 0};
  for (std::size_t i = 0; i < cast.crowd.size(); ++i) {
    if (!is_considered[i]) continue;
    const double mm = FaceSpace::distance(point, cast.points[i]);
    if (nearest.earlier_face && mm >= nearest.earlier_face_distance_mm) continue;
    nearest.earlier_face = cast.crowd[i].id;
    nearest.earlier_face_distance_mm = mm;
  }
  return nearest;
}

std::optional<RejectionReason> AvoidedFaces::rejection_reason(const FaceSpace::Point& point) const {
  const bool is_near = std::ranges::any_of(points_, [&](const FaceSpace::Point& other) {
    return FaceSpace::distance(point, other) < min_distance_mm_;
  });
  return is_near ? std::optional(RejectionReason::kMinDistance) : std::nullopt;
}

void apply_changes_of_config(const CastingOptions& casting, const FaceJudge& judge,
                             CastingResult& cast) {
  apply(casting, judge, casting.changes, "config", true, cast);
}

void reapply_changes(const CastingOptions& casting, const FaceJudge& judge, std::size_t face,
                     CastingResult& cast) {
  if (cast.changed.contains(face)) FaceChanger(casting, judge, face, cast).apply();
}

}  // namespace crowdface
