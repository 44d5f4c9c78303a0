// SPDX-License-Identifier: Apache-2.0
// Describes a job as JSON. The page loads this description before it shows the first face.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/core/version.h"
#include "crowdface/editor/edit_session.h"
#include "crowdface/editor/edited_folder.h"
#include "crowdface/editor/recipe_json.h"
#include "crowdface/page/binary_answer.h"
#include "crowdface/pictures/change_choices.h"
#include "crowdface/pictures/surfaces.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Number of steps of a smoothness slider. See smoothness_at for the smoothness of each step.
constexpr int kSliderSteps = 256;

double smoothness_at(int step) {
  const double root = static_cast<double>(step) / kSliderSteps;
  return root * root;
}

Json axis_to_json(Axis axis) {
  Json json = {0, 0, 0};
  json[static_cast<std::size_t>(axis.index)] = axis.sign;
  return json;
}

Json colour_to_json(const LinearRgb& light) {
  return {light[0], light[1], light[2]};
}

std::string hex_colour(const Eigen::Vector3f& colour) {
  std::string text = "#";
  for (int c = 0; c < 3; ++c) {
    text += hex(static_cast<std::uint64_t>(std::lround(255 * colour[c])), 2);
  }
  return text;
}

/// The range of smoothness from which casting samples, as fractions of L_max.
Range fractions_of(const SmoothnessDistribution& smoothness, const SmoothingLevelScale& scale) {
  const auto fraction = [&](double value) {
    double share = value;
    if (smoothness.unit == SmoothnessDistribution::Unit::kIterations) {
      share = value / static_cast<double>(scale.max_level);
    } else if (smoothness.unit == SmoothnessDistribution::Unit::kSize && value > 0) {
      share = static_cast<double>(
                  iterations_for_wavelength(scale.operator_kind, value, scale.edge_length_mm)) /
              static_cast<double>(scale.max_level);
    }
    return std::min(share, 1.0);
  };
  return {fraction(smoothness.range.low), fraction(smoothness.range.high)};
}

Json range_to_json(const Range& range) {
  return {{"min", range.low}, {"max", range.high}};
}

}  // namespace

Json EditSession::regions_json() const {
  Json regions = Json::array();
  for (std::size_t k = 0; k < casting_.region_names.size(); ++k) {
    const RegionSampling& sampling = casting_.sampling.regions[k];
    regions.push_back(
        {{"name", casting_.region_names[k]},
         {"colour", hex_colour(palette_colour(static_cast<Index>(k)))},
         {"smoothness", range_to_json(fractions_of(sampling.smoothness, casting_.level_scale))},
         {"extrapolation", range_to_json(sampling.extrapolation)}});
  }
  return regions;
}

FacePlan EditSession::first_face() const {
  if (crowd_ && !crowd_->empty()) return crowd_->front();
  FacePlan face;
  face.id = "edited";
  for (std::size_t k = 0; k < casting_.sampling.regions.size(); ++k) {
    RegionRecipe region;
    region.finer_bands.resize(band_count(casting_.sampling) - 1);
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const Range smoothness =
          fractions_of(smoothness_of(casting_.sampling, k, b), casting_.level_scale);
      BandRecipe& band = band_of(region, b);
      band.position = casting_.anchors.front();
      band.weights =
          weights_at_position(casting_.anchors, 0, sources_of(casting_.sampling, b), *band.position,
                              casting_.normalization, casting_.sampling.max_sources);
      band.smoothness = (smoothness.low + smoothness.high) / 2;
      band.iterations = iterations_of(band.smoothness, casting_.level_scale);
    }
    face.recipe.regions.push_back(std::move(region));
  }
  return face;
}

Json EditSession::description() const {
  const Config& config = job_.config;
  Json json;
  json["name"] = config.crowd.name;
  json["seed"] = config.crowd.seed;
  json["version"] = kVersion;
  json["unit"] = name_of(config.faces.units);
  json["mm_per_unit"] = mm_per(config.faces.units);
  json["up"] = axis_to_json(config.faces.up);
  json["front"] = axis_to_json(config.faces.front);
  json["max_iterations"] = casting_.level_scale.max_level;
  json["edge_mm"] = casting_.level_scale.edge_length_mm;
  json["vertices"] = job_.inputs.head_set.topology.vertex_count;
  json["regions"] = regions_json();
  for (std::size_t b = 0; b < config.sampling->bands.size(); ++b) {
    Json begins = Json::array();  // initial value for each region
    for (std::size_t k = 0; k < casting_.region_names.size(); ++k) {
      const Range range = fractions_of(smoothness_of(*config.sampling, k, b), casting_.level_scale);
      begins.push_back((range.low + range.high) / 2);
    }
    json["bands"].push_back({{"name", config.sampling->bands[b].name},
                             {"smoothness", std::move(begins)},
                             {"sources", sources_of(*config.sampling, b)}});
  }
  json["heads"] = Json::array();
  for (std::size_t h = 0; h < config.faces.names.size(); ++h) {
    json["heads"].push_back({{"name", config.faces.names[h]},
                             {"tags", config.faces.tags[h]},
                             {"anchor", {casting_.anchors[h].x(), casting_.anchors[h].y()}},
                             {"texture", textures_.has_textures_of(static_cast<Index>(h))}});
  }
  json["normalization"] =
      config.blending.normalization == Normalization::kPartition ? "partition" : "printed";
  json["falloff"] = 2;
  json["sources"] = config.sampling->sources;
  json["max_sources"] =
      config.sampling->max_sources ? Json(*config.sampling->max_sources) : Json(nullptr);
  json["formats"] = EditedFolder::formats();
  json["limits"] = {{"head_mm", config.diversity->min_distance_to_heads_mm},
                    {"face_mm", config.diversity->min_distance_mm}};
  for (int step = 0; step <= kSliderSteps; ++step) {
    const std::uint64_t level = iterations_of(smoothness_at(step), casting_.level_scale);
    json["levels"]["smoothness"].push_back(smoothness_at(step));
    json["levels"]["iterations"].push_back(level);
    json["levels"]["size_mm"].push_back(wavelength_of_iterations(
        casting_.level_scale.operator_kind, level, casting_.level_scale.edge_length_mm));
  }
  json["start"] = recipe_to_json(first_face(), casting_, config);
  json["crowd"] = nullptr;
  if (crowd_) {
    json["crowd"] = {{"directory", config.output.directory.string()}, {"faces", Json::array()}};
    add_possible_changes(config, job_.inputs.textures.has_textures(), json["crowd"]);
    for (const FacePlan& face : *crowd_) {
      Json entry = recipe_to_json(face, casting_, config);
      entry["index"] = face.index ? Json(*face.index) : Json(nullptr);
      entry["attempt"] = face.notes.attempt;
      if (!face.notes.changes.empty()) entry["changed"] = face.notes.changes;
      entry["family"] = face.family ? Json(*face.family) : Json(nullptr);
      if (face.group) entry["group"] = *face.group;
      json["crowd"]["faces"].push_back(std::move(entry));
    }
  }
  json["can_generate"] = true;
  json["can_paint"] = job_.inputs.head_set.uvs.rows() > 0;
  return json;
}

std::string EditSession::mesh_answer() const {
  const HeadSet& head_set = job_.inputs.head_set;
  const Surfaces surfaces = surfaces_of(job_.config, job_.inputs);
  const Positions mean = mean_head(head_set);
  const VertexColours of_all =
      surface_colours(head_set.topology, surfaces, mean, job_.config.faces.front);
  const RegionWeights::Alpha& alpha = builder_.regions().alpha;
  std::vector<bool> is_part(static_cast<std::size_t>(head_set.topology.vertex_count), false);
  for (const Part& part : job_.inputs.parts.parts) {
    for (const std::uint32_t v : part.vertices) is_part[v] = true;
  }
  std::vector<std::uint8_t> colours, parts, textured;
  std::vector<float> masks;
  for (const std::uint32_t v : preview_.vertices) {
    for (int c = 0; c < 3; ++c) {
      colours.push_back(static_cast<std::uint8_t>(std::lround(255 * of_all(v, c))));
    }
    for (Index k = 0; k < alpha.cols(); ++k) masks.push_back(static_cast<float>(alpha(v, k)));
    parts.push_back(is_part[v] ? 1 : 0);
  }
  for (const std::uint32_t face : preview_.face_of_vertex)
    textured.push_back(textures_.covers_polygon(face) ? 1 : 0);
  Eigen::Array3d low = mean.row(0).array(), high = low;
  for (const Head& head : head_set.heads) {
    low = low.min(head.positions.colwise().minCoeff().transpose().array());
    high = high.max(head.positions.colwise().maxCoeff().transpose().array());
  }
  BinaryAnswer answer;
  answer.json["vertices"] = preview_.vertices.size();
  answer.json["low"] = {low[0], low[1], low[2]};
  answer.json["high"] = {high[0], high[1], high[2]};
  const auto add = [&](std::string_view name, const auto& values) {
    answer.add(name, std::span(values));
  };
  add("triangles", preview_.triangles);
  add("draft", draft_triangles(preview_, mean, kMaxDraftTriangles));
  add("colours", colours);
  add("alpha", masks);
  if (!preview_.uvs.empty()) add("uv", preview_.uvs);
  add("twin", preview_.first_copy_of_vertex);
  add("part", parts);
  add("textured", textured);
  if (const auto eyes =
          eye_coordinates(head_set.topology, surfaces, mean, job_.config.faces.front)) {
    answer.json["eyes"] = {{"pupil", kPupilRadius},
                           {"iris", kIrisRadius},
                           {"softness", kIrisSoftness},
                           {"white", colour_to_json(albedo_of(SurfaceKind::kEye))},
                           {"colour", colour_to_json(albedo_of(SurfaceKind::kIris))}};
    std::vector<float> places;
    for (const std::uint32_t v : preview_.vertices) {
      for (int c = 0; c < 3; ++c) places.push_back((*eyes)(v, c));
    }
    add("eyes", places);
  }
  return answer.bytes();
}

std::string EditSession::ambient_light_answer() const {
  std::vector<std::uint8_t> roots;
  for (const float share : sky_visibility_.get()) {
    roots.push_back(static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share))));
  }
  BinaryAnswer answer;
  answer.add("light", std::span(std::as_const(roots)));
  return answer.bytes();
}

std::string EditSession::head_answer(Index head) const {
  const HeadSmoothing levels = preview_levels()[static_cast<std::size_t>(head)];
  // Quantise all numbers of a field with the same step size, because the page stores a field in one
  // texture.
  std::vector<float> values;
  for (Index p = 0; p < levels.fields.rank; ++p) {
    for (const std::uint32_t vertex : preview_.vertices) {
      for (Index c = 0; c < 3; ++c) {
        values.push_back(static_cast<float>(levels.fields.value(p, vertex, c)));
      }
    }
  }
  std::vector<float> steps;
  std::vector<std::int16_t> fields(values.size());
  const std::size_t of_field = 3 * preview_.vertices.size();
  for (std::size_t at = 0; at < values.size(); at += of_field) {
    steps.push_back(
        quantize(std::span(std::as_const(values)).subspan(at, of_field), fields.data() + at));
  }
  std::vector<float> functions;
  for (int step = 0; step <= kSliderSteps; ++step) {
    for (const double value :
         levels.functions(iterations_of(smoothness_at(step), casting_.level_scale))) {
      functions.push_back(static_cast<float>(value));
    }
  }
  const std::vector<float> positions =
      preview_points(job_.inputs.head_set.heads[static_cast<std::size_t>(head)].positions);
  BinaryAnswer answer;
  answer.json["rank"] = levels.fields.rank;
  answer.json["scale"] = steps;
  answer.add("positions", std::span(positions));
  answer.add("fields", std::span(std::as_const(fields)));
  answer.add("functions", std::span(std::as_const(functions)));
  return answer.bytes();
}

}  // namespace crowdface
