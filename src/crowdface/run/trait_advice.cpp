// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/trait_advice.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/text.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

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

}  // namespace crowdface
