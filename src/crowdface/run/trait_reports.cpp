// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/trait_reports.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/shares.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"

namespace crowdface {

namespace {

/// The landmarks of randomly sampled faces. These faces need not satisfy limits or constraints.
std::vector<Positions> sampled_landmarks(const CastingOptions& casting,
                                         const FaceMeasurer& measurer) {
  constexpr std::uint64_t kSampled = 2000;
  const std::vector<FaceDistribution> kinds = face_distributions(casting);
  const std::vector<int> schedule = schedule_groups(casting.groups, kSampled);
  std::vector<Positions> landmarks(kSampled);
  parallel_for_each(kSampled, [&](std::size_t i) {
    const FaceDistribution& kind = kinds[static_cast<std::size_t>(schedule[i] + 1)];
    landmarks[i] = measurer.landmarks(random_face(casting, i + 1, 0, kind).recipe);
  });
  return landmarks;
}

}  // namespace

std::vector<TraitReport> report_traits(const CastingOptions& casting, const FaceTraits& traits,
                                       const std::vector<FacePlan>& crowd) {
  std::vector<TraitReport> reports;
  std::vector<Positions> drawn;
  if (!casting.trait_targets.empty()) drawn = sampled_landmarks(casting, traits.measurer());
  for (std::size_t t = 0; t < traits.trait_indices().size(); ++t) {
    const std::size_t trait = traits.trait_indices()[t];
    TraitReport report{
        trait, quartiles(traits.measurer().head_distributions().sorted_values(trait)), {}, {}};
    std::vector<double> all, sampled;
    for (const FacePlan& face : crowd) {
      all.push_back(face.traits[t]);
      if (face.index) sampled.push_back(face.traits[t]);
    }
    report.crowd_values = quartiles(std::move(all));
    const auto target = std::ranges::find(casting.trait_targets, trait, &TraitTarget::trait);
    if (target != casting.trait_targets.end() && !sampled.empty()) {
      double low = HUGE_VAL, high = -HUGE_VAL, mean = 0, squares = 0;
      for (const Positions& points : drawn) {
        const double value = measure(measurements()[trait], points);
        low = std::min(low, value);
        high = std::max(high, value);
      }
      const auto count = static_cast<double>(sampled.size());
      for (const double value : sampled) mean += value / count;
      for (const double value : sampled) squares += (value - mean) * (value - mean);
      report.comparison = {*target,
                           mean,
                           std::sqrt(squares / std::max(count - 1, 1.0)),
                           kolmogorov_smirnov_distance(*target, sampled),
                           normal_cdf(*target, low),
                           1 - normal_cdf(*target, high)};
    }
    reports.push_back(report);
  }
  return reports;
}

std::vector<std::string> population_warnings(const std::vector<TraitReport>& reports) {
  constexpr double kTooFar = 0.08, kPercent = 100;
  std::vector<std::string> warnings;
  for (const TraitReport& report : reports) {
    if (!report.comparison || report.comparison->max_difference <= kTooFar) continue;
    const TraitReport::TargetComparison& comparison = *report.comparison;
    const Measurement& of = measurements()[report.trait_index];
    warnings.push_back(
        concat("population: ", of.name, " has the mean ", format_trait(of, comparison.mean),
               " (asked for: ", format_trait(of, comparison.target.mean),
               ") and the standard deviation ", format_trait(of, comparison.standard_deviation),
               " (asked for: ", format_trait(of, comparison.target.deviation), "); ",
               format_fixed(kPercent * comparison.fraction_below, 0),
               " % of the requested distribution lie below and ",
               format_fixed(kPercent * comparison.fraction_above, 0),
               " % above all faces that can be drawn from these heads"));
  }
  return warnings;
}

std::string format_trait_ranges(const Config& config, const Inputs& inputs,
                                const PreparedHeads& prepared, const CastingOptions& casting) {
  const auto traits = available_face_traits(config, inputs, prepared);
  if (!traits) return {};
  const std::vector<Positions> drawn = sampled_landmarks(casting, traits->measurer());
  constexpr std::size_t kNameWidth = 24, kNumberWidth = 9;
  const auto column = [](const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
  };
  std::string table = concat("measurement                 heads: least  greatest",
                             "   faces: least      1 %     50 %     99 %  greatest\n");
  for (const std::size_t trait : traits->trait_indices()) {
    const Measurement& of = measurements()[trait];
    const std::vector<double>& heads = traits->measurer().head_distributions().sorted_values(trait);
    std::vector<double> faces;
    for (const Positions& points : drawn) faces.push_back(measure(of, points));
    std::ranges::sort(faces);
    const auto at = [&](double share) {
      return faces[static_cast<std::size_t>(share * static_cast<double>(faces.size() - 1))];
    };
    std::string line(of.name);
    line.resize(std::max(kNameWidth, line.size()), ' ');
    line += unit_of(of) == " mm" ? " mm" : unit_of(of).empty() ? "   " : "  °";
    const auto add = [&](double value, std::size_t more) {
      line += column(format_fixed(value, unit_of(of).empty() ? 3 : 1), kNumberWidth + more);
    };
    add(heads.front(), 4);
    add(heads.back(), 1);
    add(faces.front(), 6);
    add(at(0.01), 0);
    add(at(0.5), 0);
    add(at(0.99), 0);
    add(faces.back(), 1);
    table += line + '\n';
  }
  return table;
}

}  // namespace crowdface
