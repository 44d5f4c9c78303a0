// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_session.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/core/version.h"
#include "crowdface/editor/binary_answer.h"
#include "crowdface/editor/crowd_of_job.h"
#include "crowdface/editor/recipe_json.h"
#include "crowdface/pictures/surfaces.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Steps of the sliders' square-root scale.
constexpr int kLevels = 256;

double smoothness_at(int step) {
  const double root = static_cast<double>(step) / kLevels;
  return root * root;
}

Json axis_to_json(Axis axis) {
  Json json = {0, 0, 0};
  json[static_cast<std::size_t>(axis.index)] = axis.sign;
  return json;
}

Json colour_to_json(const Light& light) {
  return {light[0], light[1], light[2]};
}

std::string hex_colour(const Eigen::Vector3f& colour) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (int c = 0; c < 3; ++c) {
    const auto value = static_cast<unsigned>(std::lround(255 * colour[c]));
    text += kDigits[value >> 4U & 15U];
    text += kDigits[value & 15U];
  }
  return text;
}

/// The smoothnesses that casting would draw within, as shares of L_max.
Range fractions_of(const SmoothnessDistribution& smoothness, const LevelScale& scale) {
  const auto fraction = [&](double value) {
    double share = value;
    if (smoothness.unit == SmoothnessDistribution::Unit::kIterations) {
      share = value / static_cast<double>(scale.max_level);
    } else if (smoothness.unit == SmoothnessDistribution::Unit::kSize && value > 0) {
      share = static_cast<double>(iterations_of_size(scale.kind, value, scale.edge_length_mm)) /
              static_cast<double>(scale.max_level);
    }
    return std::min(share, 1.0);
  };
  return {fraction(smoothness.range.low), fraction(smoothness.range.high)};
}

Json range_to_json(const Range& range) {
  return {{"min", range.low}, {"max", range.high}};
}

std::vector<bool> drawn_faces(const Surfaces& surfaces) {
  std::vector<bool> drawn;
  for (const SurfaceKind kind : surfaces.kinds) drawn.push_back(kind != SurfaceKind::kHidden);
  return drawn;
}

Config with_fitted_levels(Config config) {
  config.smoothing.levels = Levels::kBasis;
  return config;
}

std::string sentence(Reason reason, const Config& config) {
  const BelievabilityOptions& limits = config.believability;
  switch (reason) {
    case Reason::kMaxWeight:
      return concat("one head has more weight in a region than diversity.max_weight allows (",
                    config.diversity.max_weight, ")");
    case Reason::kMinDistanceToFaces:
      return concat("nearer to a head than diversity.min_distance_to_faces (",
                    config.diversity.min_distance_to_faces_mm, " mm)");
    case Reason::kImplausible:
      return concat("farther from the heads' mean than believability.max_deviation (",
                    limits.max_deviation, ")");
    case Reason::kStretched:
      return concat("skin is stretched more than believability.max_stretch (", limits.max_stretch,
                    ")");
    case Reason::kFlipped:
      return concat("more of the skin is turned over than believability.max_flipped (",
                    limits.max_flipped, ")");
    case Reason::kIntersecting:
      return concat(
          "more of the skin passes through other skin than "
          "believability.max_intersecting (",
          limits.max_intersecting, ")");
    case Reason::kGap:
      return concat(
          "lips, or other skin that nearly touches, part by more than "
          "believability.max_gap (",
          limits.max_gap_mm, " mm)");
    default:
      return concat("believability.", name_of(reason));
  }
}

}  // namespace

EditSession::EditSession(Job job, const std::filesystem::path& cache, std::size_t preview_vertices)
    : job_(std::move(job)),
      crowd_(crowd_of_job(job_)),
      prepared_(prepare(job_.config, job_.inputs, job_.smoothing, cache)),
      builder_(job_.config, job_.inputs, prepared_),
      judging_(std::async(std::launch::async, [this] { return judging(); }).share()),
      casting_(casting_of(job_.config, job_.inputs,
                          job_.config.plane.layout == Layout::kSimilarity
                              ? judging_.get().where->space.head_distances()
                              : Eigen::MatrixXd())),
      preview_(preview_mesh(job_.inputs.faces, mean_head(job_.inputs.faces),
                            drawn_faces(surfaces_of(job_.config, job_.inputs)), preview_vertices)),
      around_(job_.inputs.faces.topology) {
  if (job_.config.smoothing.levels == Levels::kExact) {
    fitted_ = prepare(with_fitted_levels(job_.config), job_.inputs, job_.smoothing, cache);
  }
}

EditSession::Judging EditSession::judging() const {
  auto where =
      std::make_unique<const CastingSpace>(casting_space(job_.config, job_.inputs, prepared_));
  const FaceSpace& space = where->space;
  FacePointIndex crowd(space.dimensions());
  if (crowd_) {
    std::vector<FaceSpace::Point> points(crowd_->size());
    parallel_for_each(points.size(),
                      [&](std::size_t i) { points[i] = space.point((*crowd_)[i].recipe); });
    for (const FaceSpace::Point& point : points) crowd.add(point);
  }
  FaceJudge judge(space, job_.config.diversity, job_.config.believability, &where->skin);
  return {std::move(where), std::move(judge), std::move(crowd)};
}

Json EditSession::regions_json() const {
  Json regions = Json::array();
  for (std::size_t k = 0; k < casting_.region_names.size(); ++k) {
    const RegionSampling& sampling = casting_.sampling.regions[k];
    regions.push_back(
        {{"name", casting_.region_names[k]},
         {"colour", hex_colour(palette_colour(static_cast<Index>(k)))},
         {"smoothness", range_to_json(fractions_of(sampling.smoothness, casting_.scale))},
         {"extrapolation", range_to_json(sampling.extrapolation)}});
  }
  return regions;
}

CastFace EditSession::first_face() const {
  if (crowd_ && !crowd_->empty()) return crowd_->front();
  CastFace face;
  face.id = "edited";
  for (const RegionSampling& sampling : casting_.sampling.regions) {
    const Range smoothness = fractions_of(sampling.smoothness, casting_.scale);
    RegionRecipe region;
    region.position = casting_.anchors.front();
    region.weights = weights_at(casting_.anchors, 0, casting_.sampling.sources, *region.position,
                                casting_.normalization, casting_.sampling.max_sources);
    region.smoothness = (smoothness.low + smoothness.high) / 2;
    region.iterations = iterations_of(region.smoothness, casting_.scale);
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
  json["max_iterations"] = casting_.scale.max_level;
  json["edge_mm"] = casting_.scale.edge_length_mm;
  json["vertices"] = job_.inputs.faces.topology.vertex_count;
  json["regions"] = regions_json();
  json["heads"] = Json::array();
  for (std::size_t h = 0; h < config.faces.names.size(); ++h) {
    json["heads"].push_back({{"name", config.faces.names[h]},
                             {"tags", config.faces.tags[h]},
                             {"anchor", {casting_.anchors[h].x(), casting_.anchors[h].y()}},
                             {"texture", false}});
  }
  json["normalization"] =
      config.blending.normalization == Normalization::kPartition ? "partition" : "printed";
  json["falloff"] = 2;
  json["sources"] = config.sampling.sources;
  json["max_sources"] =
      config.sampling.max_sources ? Json(*config.sampling.max_sources) : Json(nullptr);
  json["formats"] = {"obj", "ply", "glb", "npy"};
  json["limits"] = {{"head_mm", config.diversity.min_distance_to_faces_mm},
                    {"face_mm", config.diversity.min_distance_mm}};
  for (int step = 0; step <= kLevels; ++step) {
    const std::uint64_t level = iterations_of(smoothness_at(step), casting_.scale);
    json["levels"]["smoothness"].push_back(smoothness_at(step));
    json["levels"]["iterations"].push_back(level);
    json["levels"]["size_mm"].push_back(
        size_of_iterations(casting_.scale.kind, level, casting_.scale.edge_length_mm));
  }
  json["start"] = recipe_to_json(first_face(), casting_, config);
  json["crowd"] = nullptr;
  if (crowd_) {
    json["crowd"] = {{"directory", config.output.directory.string()}, {"faces", Json::array()}};
    for (const CastFace& face : *crowd_) {
      Json entry = recipe_to_json(face, casting_, config);
      if (face.family) entry["family"] = *face.family;
      if (face.group) entry["group"] = *face.group;
      json["crowd"]["faces"].push_back(std::move(entry));
    }
  }
  json["can_generate"] = false;
  return json;
}

std::string EditSession::mesh() const {
  const FaceSet& faces = job_.inputs.faces;
  const Surfaces surfaces = surfaces_of(job_.config, job_.inputs);
  const Positions mean = mean_head(faces);
  const VertexColours of_all =
      surface_colours(faces.topology, surfaces, mean, job_.config.faces.front);
  const RegionWeights::Alpha& alpha = builder_.regions().alpha;
  std::vector<bool> is_part(static_cast<std::size_t>(faces.topology.vertex_count), false);
  for (const Part& part : job_.inputs.parts.parts) {
    for (const std::uint32_t v : part.vertices) is_part[v] = true;
  }
  std::vector<std::uint8_t> colours, parts;
  std::vector<float> masks;
  for (const std::uint32_t v : preview_.vertices) {
    for (int c = 0; c < 3; ++c) {
      colours.push_back(static_cast<std::uint8_t>(std::lround(255 * of_all(v, c))));
    }
    for (Index k = 0; k < alpha.cols(); ++k) masks.push_back(static_cast<float>(alpha(v, k)));
    parts.push_back(is_part[v] ? 1 : 0);
  }
  Eigen::Array3d low = mean.row(0).array(), high = low;
  for (const Head& head : faces.heads) {
    low = low.min(head.positions.colwise().minCoeff().transpose().array());
    high = high.max(head.positions.colwise().maxCoeff().transpose().array());
  }
  BinaryAnswer answer;
  answer.head["vertices"] = preview_.vertices.size();
  answer.head["low"] = {low[0], low[1], low[2]};
  answer.head["high"] = {high[0], high[1], high[2]};
  const auto add = [&](std::string_view name, const auto& values) {
    answer.add(name, std::span(values));
  };
  add("triangles", preview_.triangles);
  add("colours", colours);
  add("alpha", masks);
  if (!preview_.uvs.empty()) add("uv", preview_.uvs);
  add("twin", preview_.twins);
  add("part", parts);
  if (const auto eyes = eye_coordinates(faces.topology, surfaces, mean, job_.config.faces.front)) {
    answer.head["eyes"] = {{"pupil", kPupilRadius},
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

std::vector<HeadLevels> EditSession::preview_levels() const {
  if (!fitted_) return head_levels(job_.config, prepared_);
  return head_levels(with_fitted_levels(job_.config), *fitted_);
}

std::string EditSession::head(Index head) const {
  const HeadLevels levels = preview_levels()[static_cast<std::size_t>(head)];
  const auto vertices = static_cast<std::size_t>(job_.inputs.faces.topology.vertex_count);
  const auto rank = static_cast<std::size_t>(levels.rank);
  const std::size_t shown = 3 * preview_.vertices.size();
  std::vector<std::int16_t> fields(rank * shown);
  std::vector<double> scales(rank, 1.0);
  parallel_for_each(rank, [&](std::size_t p) {
    const float* field = levels.fields.data() + 3 * p * vertices;
    const auto value = [&](std::size_t i) {
      return field[std::size_t{3} * preview_.vertices[i / 3] + i % 3];
    };
    float largest = 0;
    for (std::size_t i = 0; i < shown; ++i) largest = std::max(largest, std::abs(value(i)));
    if (largest == 0) return;
    scales[p] = static_cast<double>(largest) / std::numeric_limits<std::int16_t>::max();
    for (std::size_t i = 0; i < shown; ++i) {
      fields[p * shown + i] = static_cast<std::int16_t>(std::lround(value(i) / scales[p]));
    }
  });
  std::vector<float> functions;
  for (int step = 0; step <= kLevels; ++step) {
    for (const double value :
         levels.functions(iterations_of(smoothness_at(step), casting_.scale))) {
      functions.push_back(static_cast<float>(value));
    }
  }
  const std::vector<float> positions =
      points(job_.inputs.faces.heads[static_cast<std::size_t>(head)].positions);
  BinaryAnswer answer;
  answer.head["rank"] = rank;
  answer.head["scale"] = scales;
  answer.add("positions", std::span(positions));
  answer.add("fields", std::span(std::as_const(fields)));
  answer.add("functions", std::span(std::as_const(functions)));
  return answer.bytes();
}

Positions EditSession::build(const Recipe& recipe) const {
  const Recipe* one = &recipe;
  Positions face;
  builder_.build(std::span(&one, 1), std::span(&face, 1));
  return face;
}

FaceMeasures EditSession::measure(const CastFace& recipe, const Positions& face) const {
  const Judging& judging = judging_.get();
  const FaceJudge& judge = judging.judge;
  const FaceSpace::Point point = judge.space().point(recipe.recipe);
  FaceMeasures measures;
  const FacePointIndex::Nearest head = judge.nearest_head(point);
  measures.head = head.face;
  measures.head_mm = head.mm;
  if (crowd_) {
    const auto own = std::find_if(crowd_->begin(), crowd_->end(),
                                  [&](const CastFace& other) { return other.id == recipe.id; });
    const Index at = own - crowd_->begin();
    FacePointIndex::Nearest nearest = judging.crowd.nearest(point, HUGE_VAL, 0, at);
    if (own != crowd_->end()) {
      const auto after = judging.crowd.nearest(point, nearest.mm, at + 1);
      if (after.face >= 0) nearest = after;
    }
    if (nearest.face >= 0) {
      measures.face = static_cast<std::size_t>(nearest.face);
      measures.face_mm = nearest.mm;
    }
  }
  if (const auto why = judge.at_a_glance(recipe.recipe, point)) {
    measures.warnings.push_back(sentence(*why, job_.config));
  }
  if (const auto why = judge.closely(recipe.recipe)) {
    measures.warnings.push_back(sentence(*why, job_.config));
  }
  if (job_.config.believability.check &&
      builder_.wider_mm(face) > job_.config.believability.max_gap_mm) {
    measures.warnings.push_back(sentence(Reason::kGap, job_.config));
  }
  return measures;
}

std::vector<float> EditSession::points(const Positions& face) const {
  std::vector<float> points;
  points.reserve(3 * preview_.vertices.size());
  for (const std::uint32_t v : preview_.vertices) {
    for (int c = 0; c < 3; ++c) points.push_back(static_cast<float>(face(v, c)));
  }
  return points;
}

std::vector<float> EditSession::normals(const Positions& face) const {
  constexpr std::size_t kBlock = 1024;
  std::vector<float> normals(3 * preview_.vertices.size());
  parallel_for_each(preview_.vertices.size(), kBlock, [&](std::size_t i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t f : around_.of(preview_.vertices[i])) {
      sum += face_area_vector(job_.inputs.faces.topology, f, face);
    }
    const double length = sum.norm();
    const Eigen::Vector3d normal =
        length > 0 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::UnitZ();
    for (int c = 0; c < 3; ++c) {
      normals[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(normal[c]);
    }
  });
  return normals;
}

}  // namespace crowdface
