// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/head_traits.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/paint/face_landmarks.h"
#include "crowdface/pick/landmark_file.h"

namespace crowdface {
namespace {

void take_from_file(const Config& config, const Positions& mean, HeadLandmarks& landmarks) {
  const LandmarkFile file = read_landmarks(config.landmarks, LandmarkMesh::kTemplate);
  for (const auto& [name, place] : file.template_places) {
    const auto known = std::ranges::find(trait_landmarks(), name, &TraitLandmark::name);
    if (known == trait_landmarks().end()) {
      throw UsageError(concat(config.landmarks.string(), ": no measurement needs a landmark ",
                              quoted(name), "; docs/traits.md lists all landmarks"));
    }
    const std::uint32_t v = template_vertex(place, mean);
    const auto at = static_cast<std::size_t>(known - trait_landmarks().begin());
    landmarks.surface_points[at] = SurfacePoint{{v, v, v}, {1, 0, 0}, row3(mean, v), 0};
    landmarks.missing_reasons[at].clear();
  }
}

}  // namespace

bool HeadLandmarks::can_measure(const Measurement& measurement) const {
  return std::ranges::all_of(landmarks_of(measurement),
                             [&](std::size_t l) { return surface_points[l].has_value(); });
}

std::string HeadLandmarks::missing_landmark_reason(const Measurement& measurement) const {
  for (const std::size_t l : landmarks_of(measurement)) {
    if (!surface_points[l])
      return concat("no ", trait_landmarks()[l].name, ": ", missing_reasons[l]);
  }
  return {};
}

Positions HeadLandmarks::landmark_positions(const Positions& mesh, double mm_per_unit) const {
  Positions points = Positions::Zero(static_cast<Index>(surface_points.size()), 3);
  for (std::size_t l = 0; l < surface_points.size(); ++l) {
    if (!surface_points[l]) continue;
    points.row(static_cast<Index>(l)) =
        mm_per_unit *
        point_on(mesh, surface_points[l]->corners, surface_points[l]->barycentric).transpose();
  }
  return points;
}

HeadLandmarks find_head_landmarks(const Config& config, const Inputs& inputs) {
  const HeadAxes axes = head_axes(config);
  const bool has_parts = !inputs.parts.classes.empty();
  const PartList parts = has_parts ? inputs.parts
                                   : find_parts(inputs.head_set.topology, inputs.adjacency,
                                                inputs.components, inputs.mean_head, {}, axes);
  FaceLandmarks found = find_face_landmarks(inputs.head_set.topology, inputs.components, parts,
                                            inputs.mean_head, axes);
  HeadLandmarks landmarks;
  for (const TraitLandmark& landmark : trait_landmarks()) {
    const auto place = found.points.find(landmark.name);
    const auto reason = found.missing_reasons.find(landmark.name);
    landmarks.surface_points.push_back(place != found.points.end() ? std::optional(place->second)
                                                                   : std::nullopt);
    landmarks.missing_reasons.push_back(place != found.points.end() ? ""
                                        : reason != found.missing_reasons.end()
                                            ? reason->second
                                            : "no face was found");
  }
  if (!config.landmarks.empty()) take_from_file(config, inputs.mean_head, landmarks);
  return landmarks;
}

namespace {

/// The values of all measurements of all heads: #heads by #measurements; an unavailable value is
/// empty.
std::vector<std::vector<std::optional<double>>> measure_each(const Config& config,
                                                             const Inputs& inputs,
                                                             const HeadLandmarks& landmarks) {
  std::vector<std::vector<std::optional<double>>> heads;
  for (const Head& head : inputs.head_set.heads) {
    heads.push_back(measure_mesh(landmarks, head.positions, mm_per(config.faces.units)));
  }
  return heads;
}

}  // namespace

TraitDistributions measure_heads(const Config& config, const Inputs& inputs,
                                 const HeadLandmarks& landmarks) {
  return TraitDistributions(measure_each(config, inputs, landmarks), config.quantile_table.targets);
}

std::vector<std::vector<double>> head_traits_of_config(const Config& config, const Inputs& inputs) {
  const std::vector<std::size_t> named = config.named_traits();
  if (named.empty()) return {};
  const HeadLandmarks landmarks = find_head_landmarks(config, inputs);
  require_available_traits(config, landmarks);
  std::vector<std::vector<double>> values;
  for (const Head& head : inputs.head_set.heads) {
    const Positions points =
        landmarks.landmark_positions(head.positions, mm_per(config.faces.units));
    std::vector<double>& own = values.emplace_back();
    for (const std::size_t trait : named) own.push_back(measure(measurements()[trait], points));
  }
  return values;
}

void require_available_traits(const Config& config, const HeadLandmarks& landmarks) {
  for (const std::size_t trait : config.named_traits()) {
    const Measurement& measurement = measurements()[trait];
    if (landmarks.can_measure(measurement)) continue;
    throw UsageError(concat(config.file.string(), ": the measurement ", measurement.name,
                            " is not available on these heads, ",
                            landmarks.missing_landmark_reason(measurement)));
  }
}

std::vector<std::optional<double>> measure_mesh(const HeadLandmarks& landmarks,
                                                const Positions& mesh, double mm_per_unit) {
  const Positions points = landmarks.landmark_positions(mesh, mm_per_unit);
  std::vector<std::optional<double>> values;
  for (const Measurement& measurement : measurements()) {
    values.push_back(landmarks.can_measure(measurement)
                         ? std::optional(measure(measurement, points))
                         : std::nullopt);
  }
  return values;
}

std::string format_head_traits(const Config& config, const Inputs& inputs,
                               const HeadLandmarks& landmarks) {
  const auto heads = measure_each(config, inputs, landmarks);
  const TraitDistributions spread(heads);
  constexpr std::size_t kNumberWidth = 9;
  const auto right_aligned = [](const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
  };
  std::size_t name_width = 0, symbol_width = 0;
  for (const Measurement& of : measurements()) {
    name_width = std::max(name_width, of.name.size());
    symbol_width = std::max(symbol_width, of.symbol.size());
  }
  std::vector<std::string> titles = {"mean", "sd"};
  titles.insert(titles.end(), config.faces.names.begin(), config.faces.names.end());
  const std::size_t start = name_width + symbol_width + 4;
  std::string table(start, ' ');
  for (const std::string& title : titles) {
    table += concat(' ', right_aligned(title, kNumberWidth));
  }
  table += '\n';
  std::string unavailable;
  for (std::size_t m = 0; m < measurements().size(); ++m) {
    const Measurement& measurement = measurements()[m];
    if (!landmarks.can_measure(measurement)) {
      unavailable += concat("  ", measurement.name, ": ",
                            landmarks.missing_landmark_reason(measurement), '\n');
      continue;
    }
    std::vector<double> numbers = {spread.mean(m), spread.deviation(m)};
    for (const auto& head : heads) numbers.push_back(*head[m]);
    std::string line = concat(measurement.name, "  ", measurement.symbol);
    line.insert(measurement.name.size(), name_width - measurement.name.size(), ' ');
    line += std::string(start - 2 - line.size(), ' ');
    const std::string_view unit = unit_of(measurement);
    line += unit.empty() ? "  " : unit == " mm" ? "mm" : " °";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::size_t width = std::max(kNumberWidth, titles[i].size());
      line += concat(' ', right_aligned(format_fixed(numbers[i], unit.empty() ? 3 : 1), width));
    }
    table += line + '\n';
  }
  if (!unavailable.empty()) table += "not available:\n" + unavailable;
  return table;
}

}  // namespace crowdface
