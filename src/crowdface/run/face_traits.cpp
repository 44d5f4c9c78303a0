// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_traits.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "crowdface/cast/shares.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {
namespace {

/// The trajectories of all heads at some vertices, from the levels that blending uses.
std::vector<Trajectory> trajectories_at(const Config& config, const Inputs& inputs,
                                        const Prepared& prepared, const FaceSamples& samples) {
  const std::vector<std::uint64_t> levels = trajectory_levels(inputs.max_level);
  const std::vector<HeadLevels> fitted =
      prepared.filter ? std::vector<HeadLevels>() : head_levels(config, prepared);
  std::vector<Trajectory> trajectories(inputs.faces.heads.size());
  for (std::size_t h = 0; h < trajectories.size(); ++h) {
    if (prepared.filter) {
      const NodeFields fields =
          filter_nodes(*prepared.filter, *prepared.nodes, inputs.faces.heads[h].positions);
      trajectories[h] = sample_trajectory(*prepared.filter, *prepared.nodes, fields, samples);
      continue;
    }
    Trajectory& trajectory = trajectories[h];
    trajectory.resize(static_cast<Index>(levels.size()), 3 * static_cast<Index>(samples.size()));
    parallel_for_each(levels.size(), [&](std::size_t l) {
      const std::vector<double> functions = fitted[h].functions(levels[l]);
      for (std::size_t s = 0; s < samples.size(); ++s) {
        for (Index c = 0; c < 3; ++c) {
          double sum = 0;
          for (std::size_t p = 0; p < functions.size(); ++p) {
            sum += functions[p] *
                   fitted[h].fields.value(static_cast<Index>(p), static_cast<Index>(samples[s]), c);
          }
          trajectory(static_cast<Index>(l), 3 * static_cast<Index>(s) + c) =
              static_cast<float>(sum);
        }
      }
    });
  }
  return trajectories;
}

SampledHeads heads_at(const Config& config, const Inputs& inputs, const Prepared& prepared,
                      const FaceSamples& samples) {
  const FaceSamples traced =
      inputs.mirror == nullptr ? samples : with_corners(samples, *inputs.mirror);
  std::vector<Trajectory> trajectories = trajectories_at(config, inputs, prepared, traced);
  SampledHeads heads = sample_heads(inputs.faces, inputs.regions, samples, trajectories,
                                    inputs.max_level, mm_per(config.faces.units));
  heads.own = std::move(trajectories);
  heads.trajectories = heads.own;
  if (inputs.mirror != nullptr) {
    heads.image =
        sample_images(inputs.faces, inputs.regions, *inputs.mirror, samples, traced, heads);
  }
  return heads;
}

Index row_of(const FaceSamples& samples, std::uint32_t v) {
  return std::ranges::lower_bound(samples, v) - samples.begin();
}

/// The corners of the landmarks that the measurements need.
std::set<std::uint32_t> corners_of(const HeadLandmarks& landmarks,
                                   const std::vector<std::size_t>& traits) {
  std::set<std::uint32_t> corners;
  for (const std::size_t trait : traits) {
    for (const std::size_t l : landmarks_of(measurements()[trait])) {
      corners.insert(landmarks.places[l]->corners.begin(), landmarks.places[l]->corners.end());
    }
  }
  return corners;
}

/// Keeps only the places of landmarks that the measurements need.
HeadLandmarks needed_landmarks(HeadLandmarks landmarks, const std::vector<std::size_t>& traits) {
  std::set<std::size_t> needed;
  for (const std::size_t trait : traits) {
    const std::vector<std::size_t> of = landmarks_of(measurements()[trait]);
    needed.insert(of.begin(), of.end());
  }
  for (std::size_t l = 0; l < landmarks.places.size(); ++l) {
    if (!needed.contains(l)) landmarks.places[l].reset();
  }
  return landmarks;
}

}  // namespace

FaceTraits::FaceTraits(const Config& config, const Inputs& inputs, const Prepared& prepared,
                       const HeadLandmarks& landmarks, std::vector<std::size_t> traits)
    : traits_(std::move(traits)),
      landmarks_(needed_landmarks(landmarks, traits_)),
      builder_(config, inputs, prepared),
      mm_per_unit_(mm_per(config.faces.units)),
      mirror_(inputs.mirror),
      neck_(inputs.neck),
      vertex_count_(inputs.faces.topology.vertex_count) {
  const std::set<std::uint32_t> corners = corners_of(landmarks_, traits_);
  std::set<std::uint32_t> all = corners;
  if (neck_ != nullptr) all.insert(neck_->seam.rim.begin(), neck_->seam.rim.end());
  wanted_.assign(all.begin(), all.end());
  for (const std::uint32_t v : wanted_) {
    if (mirror_) all.insert(mirror_->corners[v].begin(), mirror_->corners[v].end());
  }
  for (const std::uint32_t v : builder_.contact_vertices()) all.insert(v);
  samples_.assign(all.begin(), all.end());
  heads_ = heads_at(config, inputs, prepared, samples_);

  const FaceSamples few(corners.begin(), corners.end());
  std::vector<FaceMeasurer::Landmark> rows(landmarks_.places.size());
  for (std::size_t l = 0; l < rows.size(); ++l) {
    if (!landmarks_.places[l]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      rows[l].samples[c] = row_of(few, landmarks_.places[l]->corners[c]);
      rows[l].shares[c] = landmarks_.places[l]->shares[c];
    }
  }
  measurer_.emplace(heads_at(config, inputs, prepared, few), std::move(rows),
                    measure_heads(config, inputs, landmarks),
                    [this](const Recipe& recipe) { return exact_landmarks(recipe); });
}

/// Follows the steps of FaceBuilder at a few vertices: blending and asymmetry, contacts, mirroring,
/// the bend at the neck.
Positions FaceTraits::exact_landmarks(const Recipe& recipe) const {
  Recipe plain = recipe;
  plain.mirrored = false;
  const Positions at = sample_face(heads_, plain) / mm_per_unit_;
  thread_local Positions face;  // only the rows of samples_ hold the face
  if (face.rows() != vertex_count_) face = Positions::Zero(vertex_count_, 3);
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    face.row(samples_[s]) = at.row(static_cast<Index>(s));
  }
  builder_.correct_contacts(plain, face);
  if (recipe.mirrored) mirror_wanted(face);
  if (neck_ != nullptr) neck_->seam.fit(face);
  return landmarks_.on(face, mm_per_unit_);
}

void FaceTraits::mirror_wanted(Positions& face) const {
  Positions images(static_cast<Index>(wanted_.size()), 3);
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const std::uint32_t v = wanted_[i];
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      point += mirror_->shares[v][c] * row3(face, mirror_->corners[v][c]);
    }
    point = mirror_->plane.image(point);
    const auto kept = std::ranges::lower_bound(mirror_->without, v);
    if (kept != mirror_->without.end() && *kept == v) {
      point += row3(mirror_->kept, kept - mirror_->without.begin());
    }
    images.row(static_cast<Index>(i)) = point.transpose();
  }
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    face.row(wanted_[i]) = images.row(static_cast<Index>(i));
  }
}

std::vector<double> FaceTraits::values(const Recipe& recipe) const {
  const Positions points = exact_landmarks(recipe);
  std::vector<double> values;
  for (const std::size_t trait : traits_) values.push_back(measure(measurements()[trait], points));
  return values;
}

std::unique_ptr<const FaceTraits> named_face_traits(const Config& config, const Inputs& inputs,
                                                    const Prepared& prepared) {
  std::vector<std::size_t> traits = config.named_traits();
  if (traits.empty()) return nullptr;
  const HeadLandmarks landmarks = find_head_landmarks(config, inputs);
  require_named_traits(config, landmarks);
  return std::make_unique<const FaceTraits>(config, inputs, prepared, landmarks, std::move(traits));
}

namespace {

constexpr std::uint32_t kDrawnForAdvice = 400;

/// The heads whose values lie farthest on the side that a limit asks for, at most three.
std::string farthest_heads(const Config& config, const std::vector<double>& of_heads,
                           const Measurement& measurement, bool upwards) {
  constexpr std::size_t kMost = 3;
  std::vector<std::size_t> order(of_heads.size());
  for (std::size_t h = 0; h < order.size(); ++h) order[h] = h;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return upwards ? of_heads[a] > of_heads[b] : of_heads[a] < of_heads[b];
  });
  order.resize(std::min(order.size(), kMost));
  std::vector<std::string> names;
  for (const std::size_t h : order) {
    names.push_back(
        concat(config.faces.names[h], " (", format_trait(measurement, of_heads[h]), ")"));
  }
  return join(names);
}

/// A face of the kind that could not be found, with the limits that hold for it.
FacePlan draw_of_shortfall(const CastingOptions& casting, const Shortfall& shortfall,
                           std::uint32_t attempt) {
  const auto hand = std::ranges::find(casting.recipes, shortfall.recipe, &ManualRecipe::id);
  if (!shortfall.recipe.empty() && hand != casting.recipes.end()) {
    return draw_manual_recipe(casting, *hand, attempt);
  }
  const auto family = std::ranges::find(casting.families, shortfall.family, &FamilyOptions::name);
  const bool of_family = !shortfall.family.empty() && family != casting.families.end();
  std::optional<std::size_t> group;
  if (shortfall.kind >= 0) group = static_cast<std::size_t>(shortfall.kind);
  if (of_family) group = family->group;
  FacePlan face = draw_face(casting, shortfall.reached + 1, attempt, kind_of_group(casting, group));
  if (of_family) face.family = family->name;
  return face;
}

}  // namespace

std::vector<std::string> trait_advice(const Config& config, const Inputs& inputs,
                                      const CastingOptions& casting, const FaceTraits& traits,
                                      const Shortfall& shortfall) {
  const FaceMeasurer& measurer = traits.measurer();
  const TraitRules rules(measurer, casting);
  std::vector<Positions> drawn(kDrawnForAdvice);
  TraitLimits limits;
  for (std::uint32_t i = 0; i < kDrawnForAdvice; ++i) {
    const FacePlan face = draw_of_shortfall(casting, shortfall, i);
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
      if (measurer.spread().meets(limit, value)) continue;
      const bool is_low =
          limit.at_least && value < measurer.spread().value_of(limit.trait, *limit.at_least);
      ++(is_low ? below : above);
    }
    std::string ends;
    if (limit.at_least) {
      ends += concat(" at least ", format_trait(measurement, measurer.spread().value_of(
                                                                 limit.trait, *limit.at_least)));
    }
    if (limit.at_most) {
      ends += concat(
          ends.empty() ? "" : ",", " at most ",
          format_trait(measurement, measurer.spread().value_of(limit.trait, *limit.at_most)));
    }
    std::vector<double> of_heads;
    for (const Head& head : inputs.faces.heads) {
      of_heads.push_back(
          measure(measurement, landmarks.on(head.positions, mm_per(config.faces.units))));
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

std::vector<Positions> drawn_landmarks(const CastingOptions& casting,
                                       const FaceMeasurer& measurer) {
  constexpr std::uint64_t kDrawn = 2000;
  const std::vector<FaceKind> kinds = face_kinds(casting);
  const std::vector<int> schedule = schedule_groups(casting.groups, kDrawn);
  std::vector<Positions> landmarks(kDrawn);
  parallel_for_each(kDrawn, [&](std::size_t i) {
    const FaceKind& kind = kinds[static_cast<std::size_t>(schedule[i] + 1)];
    landmarks[i] = measurer.landmarks(draw_face(casting, i + 1, 0, kind).recipe);
  });
  return landmarks;
}

std::vector<TraitReport> report_traits(const CastingOptions& casting, const FaceTraits& traits,
                                       const std::vector<FacePlan>& crowd) {
  std::vector<TraitReport> reports;
  std::vector<Positions> drawn;
  if (!casting.population.empty()) drawn = drawn_landmarks(casting, traits.measurer());
  for (std::size_t t = 0; t < traits.traits().size(); ++t) {
    const std::size_t trait = traits.traits()[t];
    TraitReport report{trait, quartiles(traits.measurer().spread().ascending(trait)), {}, {}};
    std::vector<double> all, sampled;
    for (const FacePlan& face : crowd) {
      all.push_back(face.traits[t]);
      if (face.index) sampled.push_back(face.traits[t]);
    }
    report.crowd = quartiles(std::move(all));
    const auto target = std::ranges::find(casting.population, trait, &TraitTarget::trait);
    if (target != casting.population.end() && !sampled.empty()) {
      double low = HUGE_VAL, high = -HUGE_VAL, mean = 0, squares = 0;
      for (const Positions& points : drawn) {
        const double value = measure(measurements()[trait], points);
        low = std::min(low, value);
        high = std::max(high, value);
      }
      const auto count = static_cast<double>(sampled.size());
      for (const double value : sampled) mean += value / count;
      for (const double value : sampled) squares += (value - mean) * (value - mean);
      report.asked = {*target,
                      mean,
                      std::sqrt(squares / std::max(count - 1, 1.0)),
                      largest_difference(*target, sampled),
                      normal_share(*target, low),
                      1 - normal_share(*target, high)};
    }
    reports.push_back(report);
  }
  return reports;
}

std::vector<std::string> population_warnings(const std::vector<TraitReport>& reports) {
  constexpr double kTooFar = 0.08, kPercent = 100;
  std::vector<std::string> warnings;
  for (const TraitReport& report : reports) {
    if (!report.asked || report.asked->difference <= kTooFar) continue;
    const TraitReport::Asked& asked = *report.asked;
    const Measurement& of = measurements()[report.trait];
    warnings.push_back(concat(
        "population: ", of.name, " has the mean ", format_trait(of, asked.mean),
        " and the standard deviation ", format_trait(of, asked.deviation), ", ",
        format_trait(of, asked.target.mean), " and ", format_trait(of, asked.target.deviation),
        " were asked for; of the asked distribution, ", format_fixed(kPercent * asked.below, 0),
        " % lie below and ", format_fixed(kPercent * asked.above, 0),
        " % above all faces that can be drawn from these heads"));
  }
  return warnings;
}

std::unique_ptr<const FaceTraits> available_face_traits(const Config& config, const Inputs& inputs,
                                                        const Prepared& prepared) {
  const HeadLandmarks landmarks = find_head_landmarks(config, inputs);
  require_named_traits(config, landmarks);
  std::vector<std::size_t> available;
  for (std::size_t m = 0; m < measurements().size(); ++m) {
    if (landmarks.allow(measurements()[m])) available.push_back(m);
  }
  if (available.empty()) return nullptr;
  return std::make_unique<const FaceTraits>(config, inputs, prepared, landmarks,
                                            std::move(available));
}

std::string format_trait_ranges(const Config& config, const Inputs& inputs,
                                const Prepared& prepared, const CastingOptions& casting) {
  const auto traits = available_face_traits(config, inputs, prepared);
  if (!traits) return {};
  const std::vector<Positions> drawn = drawn_landmarks(casting, traits->measurer());
  constexpr std::size_t kNameWidth = 24, kNumberWidth = 9;
  const auto column = [](const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
  };
  std::string table = concat("measurement                 heads: least  greatest",
                             "   faces: least      1 %     50 %     99 %  greatest\n");
  for (const std::size_t trait : traits->traits()) {
    const Measurement& of = measurements()[trait];
    const std::vector<double>& heads = traits->measurer().spread().ascending(trait);
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

void measure_faces(const FaceTraits& traits, std::vector<FacePlan>& crowd) {
  parallel_for_each(crowd.size(), [&](std::size_t i) {
    crowd[i].traits = traits.values(crowd[i].recipe);
    for (double& value : crowd[i].traits) value = rounded(value);
  });
}

}  // namespace crowdface
