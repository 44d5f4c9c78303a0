// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/scarcity_warning.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

using What = Shortfall::What;

/// Rounds to one significant digit: 3,480 becomes 3,000.
std::uint64_t rounded_estimate(double count) {
  const double unit = std::pow(10, std::floor(std::log10(count)));
  return static_cast<std::uint64_t>(std::round(count / unit) * unit);
}

std::string asked_of(const Config& config, RejectionReason reason) {
  return describe(reason, *config.diversity, *config.believability);
}

/// Advice for a user who extends an existing crowd. Names only config keys that can change without
/// replacing the crowd.
std::vector<std::string> advice_for_existing(const Config& config, const Remedy& remedy,
                                             const Shortfall& shortfall) {
  std::vector<std::string> advice;
  const bool grows = config.crowd.count > *config.crowd.existing_face_count;
  const bool is_first_fit = config.diversity->mode == DiversityOptions::Mode::kFirstFit;
  if (remedy.binding_constraint == RejectionReason::kMinDistance && is_first_fit) {
    const std::string smaller =
        remedy.largest_distance_mm
            ? concat("diversity.min_distance: ", *remedy.largest_distance_mm, " mm",
                     remedy.trial_face_count == config.crowd.count ? "" : " or less")
            : std::string("a smaller diversity.min_distance");
    advice.push_back(
        concat(smaller, shortfall.what == What::kChangedFace ? ", and the change in a review" : "",
               "; the ", *config.crowd.existing_face_count, " faces that exist stay as they are, ",
               "only new, redrawn and changed faces come nearer"));
  } else if (remedy.binding_constraint == RejectionReason::kRejected) {
    advice.emplace_back(
        "a change of the face in place of the mark (group, lock, traits or variant_of): changes do "
        "not keep this distance");
  }
  if (grows) {
    advice.push_back(concat("a crowd.count of ",
                            std::max(shortfall.cast_count, *config.crowd.existing_face_count)));
  }
  advice.emplace_back(
      "other keys decide who the existing faces are; to change these keys, cast another crowd with "
      "--out");
  return advice;
}

/// Changes of the config that may make the crowd possible, most promising first.
std::vector<std::string> advice(const Config& config, const Remedy& remedy,
                                const Shortfall& shortfall) {
  if (config.crowd.existing_face_count) return advice_for_existing(config, remedy, shortfall);
  std::vector<std::string> advice;
  if (remedy.largest_distance_mm) {
    const bool all = remedy.trial_face_count == config.crowd.count;
    advice.push_back(concat("the largest ", name_of(remedy.binding_constraint), " with which ",
                            all ? "all " : "the first ", remedy.trial_face_count,
                            " faces were cast in a trial: ", *remedy.largest_distance_mm, " mm",
                            all ? "" : "; more faces need a smaller value"));
  }
  if (remedy.binding_constraint == RejectionReason::kMinDistance &&
      config.diversity->mode == DiversityOptions::Mode::kFirstFit) {
    advice.emplace_back("mode: spread fits more faces at the same distance");
  }
  for (const std::string_view line : constraint_of(remedy.binding_constraint).advice) {
    advice.emplace_back(line);
  }
  if (remedy.binding_constraint == RejectionReason::kFamily &&
      std::ranges::any_of(config.families,
                          [](const auto& family) { return family.age != AgeRange{}; })) {
    advice.emplace_back("a smaller range of age");
  }
  return advice;
}

/// Returns a line of advice if a group has so few heads that the faces of the group resemble these
/// heads too much; otherwise an empty text.
std::string few_heads(const Config& config, const Group& group) {
  constexpr std::size_t kFew = 3;
  const std::vector<Eigen::Index>& sources = group.sampling.sources;
  if (sources.size() >= kFew) return {};
  std::vector<std::string> names;
  for (const Eigen::Index head : sources) {
    names.push_back(config.faces.names[static_cast<std::size_t>(head)]);
  }
  return concat("\n  - more heads in the group ", group.name, ": its only heads are ", join(names),
                " (the keys tags and without select the heads)");
}

constexpr std::uint32_t kSampledForAdvice = 400;

/// Returns the names and values of the three heads with the largest values (if `upwards`) or with
/// the smallest values.
std::string farthest_heads(const Config& config, const std::vector<double>& of_heads,
                           const Measurement& measurement, bool upwards) {
  constexpr std::size_t kMaxShownHeads = 3;
  std::vector<std::size_t> order(of_heads.size());
  for (std::size_t h = 0; h < order.size(); ++h) order[h] = h;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return upwards ? of_heads[a] > of_heads[b] : of_heads[a] < of_heads[b];
  });
  order.resize(std::min(order.size(), kMaxShownHeads));
  std::vector<std::string> names;
  for (const std::size_t h : order) {
    names.push_back(
        concat(config.faces.names[h], " (", format_trait(measurement, of_heads[h]), ")"));
  }
  return join(names);
}

/// Samples a face of the group, family or recipe for which casting found too few faces. Applies the
/// limits of this group, family or recipe.
FacePlan sample_of_shortfall(const CastingOptions& casting, const Shortfall& shortfall,
                             std::uint32_t attempt) {
  std::optional<std::size_t> group;
  if (shortfall.group_index >= 0) group = static_cast<std::size_t>(shortfall.group_index);
  std::optional<std::string> family;
  if (shortfall.what == Shortfall::What::kManualRecipe) {
    return completed_face_plan(
        casting, *std::ranges::find(casting.recipes, shortfall.name, &ManualRecipe::id), attempt);
  }
  if (shortfall.what == Shortfall::What::kFamily) {
    family = shortfall.name;
    group = std::ranges::find(casting.families, *family, &FamilyOptions::name)->group;
  }
  FacePlan face = random_face(casting, shortfall.cast_count + 1, attempt,
                              distribution_of_group(casting, group));
  face.family = family;
  return face;
}

}  // namespace

void ScarcityWarning::on_face_accepted(const RejectionCounts& rejected) {
  ++cast_face_count_;
  if (has_warned_ || casting_.diversity.mode != DiversityOptions::Mode::kFirstFit) return;
  const std::uint64_t too_near = rejected.of(RejectionReason::kMinDistance);
  const auto round =
      static_cast<std::uint64_t>(casting_.diversity.candidate_count(cast_face_count_));
  // Tell the forecast how many candidates for this face were too near to a face of the crowd, and
  // how many were far enough. Casting generates candidates in rounds of `round` candidates each. In
  // all rounds before the last round, every candidate was too near. So the remainder of `too_near`
  // divided by `round` is the number of candidates of the last round that were too near; all other
  // candidates of the last round were far enough.
  forecast_.add(too_near, round - too_near % round);
  const auto faces = forecast_.estimated_face_count();
  const auto attempts = static_cast<std::uint64_t>(casting_.diversity.max_attempts);
  if (faces && *faces < static_cast<double>(casting_.count)) {
    has_warned_ = true;
    log_warning(concat("about ", rounded_estimate(*faces), " faces fit at diversity.min_distance ",
                       casting_.diversity.min_distance_mm,
                       " mm (estimate, to a factor of three), but ", casting_.count,
                       " were requested: choose a smaller min_distance (crowdface plan --estimate "
                       "shows how many faces fit)"));
  } else if (!has_logged_scarcity_ && rejected.total() >= attempts / 20) {
    has_logged_scarcity_ = true;
    log_info(concat("candidates are getting scarce: face ", cast_face_count_, " of ",
                    casting_.count, " took ", rejected.total(),
                    " candidates; the crowd may need a smaller diversity.min_distance"));
  }
}

std::vector<std::string> trait_advice(const Config& config, const Inputs& inputs,
                                      const CastingOptions& casting, const FaceTraits& traits,
                                      const Shortfall& shortfall) {
  const FaceMeasurer& measurer = traits.measurer();
  const TraitRules rules(measurer, casting);
  std::vector<Positions> drawn(kSampledForAdvice);
  TraitLimits limits;
  for (std::uint32_t i = 0; i < kSampledForAdvice; ++i) {
    const FacePlan face = sample_of_shortfall(casting, shortfall, i);
    limits = rules.limits_of(face);
    drawn[i] = measurer.landmarks(face.recipe);
  }
  const HeadLandmarks landmarks = find_head_landmarks(config, inputs);
  std::vector<std::string> lines;
  for (const TraitLimit& limit : limits) {
    if (!limit.at_least && !limit.at_most) continue;
    const Measurement& measurement = measurements()[limit.trait];
    double low = HUGE_VAL, high = -HUGE_VAL;
    std::size_t above = 0, below = 0;
    for (const Positions& points : drawn) {
      const double value = measure(measurement, points);
      low = std::min(low, value);
      high = std::max(high, value);
      if (measurer.head_distributions().meets(limit, value)) continue;
      const bool is_low = limit.at_least && value < measurer.head_distributions().bound_value(
                                                        limit.trait, *limit.at_least);
      ++(is_low ? below : above);
    }
    std::string ends;
    if (limit.at_least) {
      ends +=
          concat(" at least ", format_trait(measurement, measurer.head_distributions().bound_value(
                                                             limit.trait, *limit.at_least)));
    }
    if (limit.at_most) {
      ends += concat(ends.empty() ? "" : ",", " at most ",
                     format_trait(measurement, measurer.head_distributions().bound_value(
                                                   limit.trait, *limit.at_most)));
    }
    std::vector<double> of_heads;
    for (const Head& head : inputs.head_set.heads) {
      of_heads.push_back(measure(
          measurement, landmarks.landmark_positions(head.positions, mm_per(config.faces.units))));
    }
    const double percent = 100.0 * static_cast<double>(drawn.size() - above - below) /
                           static_cast<double>(drawn.size());
    lines.push_back(concat(measurement.name, ends, ": ", format_fixed(percent, 0),
                           " % of the drawn faces meet it; they reach from ",
                           format_trait(measurement, low), " to ", format_trait(measurement, high),
                           "; the heads that reach farthest: ",
                           farthest_heads(config, of_heads, measurement, below >= above)));
  }
  return lines;
}

void throw_shortfall(const Config& config, const Remedy& remedy, const Shortfall& shortfall,
                     const std::vector<std::string>& trait_advice_lines) {
  const std::uint64_t rejected = shortfall.rejections.total();
  const std::uint64_t by_main = shortfall.rejections.of(remedy.binding_constraint);
  std::string message = concat(config.file.string(), ": ");
  const std::string asked = asked_of(config, remedy.binding_constraint);
  switch (shortfall.what) {
    case What::kFamily: {
      message += concat("the family ", shortfall.name, " cannot be cast: its members cannot be ",
                        "within max_distance of a founder, min_distance apart and nearer to each ",
                        "other than to all other faces (most candidates violate ", asked, ")");
      const auto family = std::ranges::find(config.families, shortfall.name, &FamilyOptions::name);
      if (family != config.families.end() && family->group) {
        message += few_heads(config, config.groups[*family->group]);
      }
      break;
    }
    case What::kManualRecipe:
      message +=
          concat("the recipe ", shortfall.name, " cannot be drawn: ", asked, ", cannot be met");
      break;
    case What::kChangedFace:
      message += concat(shortfall.name, " cannot be changed: ", asked, ", cannot be met");
      break;
    case What::kRedrawnFace:
      message += concat(shortfall.name, ", which the review rejects, cannot be redrawn: ", asked,
                        ", cannot be met");
      break;
    case What::kSampledFace:
      message +=
          concat(config.crowd.count, " faces cannot be cast: ", asked, ", cannot be met; reached ",
                 shortfall.cast_count, " of ", config.crowd.count, " faces");
      break;
  }
  if (config.diversity->mode == DiversityOptions::Mode::kFirstFit &&
      shortfall.what != What::kFamily && shortfall.what != What::kManualRecipe) {
    message += concat(" (for the next face ", by_main, " of ", rejected,
                      " candidates were rejected for this reason)");
  }
  if (shortfall.group_index >= 0) {
    const Group& group = config.groups[static_cast<std::size_t>(shortfall.group_index)];
    message += concat("; the next face belongs to the group ", group.name);
    message += few_heads(config, group);
  }
  for (const std::string& line : trait_advice_lines) message += concat("\n  - ", line);
  for (const std::string& line : advice(config, remedy, shortfall))
    message += concat("\n  - ", line);
  throw Unsatisfiable(message);
}

}  // namespace crowdface
