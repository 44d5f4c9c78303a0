// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_session.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/steer_trait.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/pictures/surfaces.h"
#include "crowdface/pictures/vertex_roughness.h"
#include "crowdface/render/studio.h"
#include "crowdface/render/visibility.h"
#include "crowdface/traits/measurements.h"

namespace crowdface {
namespace {

std::vector<bool> visible_faces(const Surfaces& surfaces) {
  std::vector<bool> drawn;
  for (const SurfaceKind kind : surfaces.kinds) drawn.push_back(kind != SurfaceKind::kHidden);
  return drawn;
}

Config with_fitted_levels(Config config) {
  config.smoothing.levels = LevelRepresentation::kBasis;
  return config;
}

std::string with_spaces(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string sentence(RejectionReason reason, const Config& config) {
  return describe_violation(reason, *config.diversity, *config.believability);
}

/// Measures a face, and adds a warning for each limit that a measurement violates.
void measure_traits(const FaceTraits& traits, const TraitRules& rules, const FacePlan& face,
                    FaceMeasures& measures) {
  const TraitDistributions& spread = traits.measurer().head_distributions();
  const std::vector<double> values = traits.values(face.recipe);
  const TraitLimits limits = rules.limits_of(face);
  for (std::size_t t = 0; t < values.size(); ++t) {
    const std::size_t trait = traits.trait_indices()[t];
    const std::vector<double>& heads = spread.sorted_values(trait);
    measures.traits.push_back(
        {trait, values[t], values[t] - spread.mean(trait), heads.front(), heads.back()});
    const auto limit = std::ranges::find(limits, trait, &TraitLimit::trait);
    if (limit == limits.end() || spread.meets(*limit, values[t])) continue;
    const Measurement& of = measurements()[trait];
    measures.warnings.push_back(
        concat(with_spaces(of.name), ", ", format_trait(of, values[t]), ", is outside its limits"));
  }
}

/// Returns the faces in the job's output folder if the folder has a plan that was made with the
/// heads, masks and smoothing settings of the job. Returns nothing if there is no plan, or (with a
/// warning) if the plan was made with other heads, masks or settings.
std::optional<std::vector<FacePlan>> crowd_of_job(const Job& job) {
  const CrowdDirectory directory = crowd_directory_of(job.config);
  if (!path_exists(directory.plan())) return std::nullopt;
  const auto refuse = [&](std::string_view why) {
    log_warning(concat(directory.root.string(), ": its faces are not shown: ", why));
    return std::nullopt;
  };
  try {
    std::vector<FacePlan> faces;
    for (PlanLine& line : read_plan(directory.plan(), job.names)) {
      if (line.settings_hash != job.settings.hex()) {
        return refuse(
            "they were planned with other heads, masks or smoothing; run crowdface generate to "
            "plan them again");
      }
      faces.push_back(std::move(line.face));
    }
    return faces;
  } catch (const InvalidInput& error) {
    return refuse(error.what());
  }
}

}  // namespace

Job load_edited_job(const std::filesystem::path& config_or_crowd, ConfigOverrides overrides,
                    const CacheFolder& cache) {
  if (!is_folder(config_or_crowd)) return load_job(config_or_crowd, overrides, cache);
  if (!overrides.out) overrides.out = config_or_crowd.string();
  return load_job(CrowdDirectory{config_or_crowd}.config(), overrides, cache);
}

EditSession::EditSession(Job job, const CacheFolder& cache, std::size_t preview_vertices)
    : job_(std::move(job)),
      textures_(job_.inputs),
      preview_future_(std::async(
          std::launch::async,
          [this, preview_vertices] {
            const HeadSet& head_set = job_.inputs.head_set;
            return preview_mesh(head_set.topology, textures_.coordinates(), mean_head(head_set),
                                visible_faces(surfaces_of(job_.config, job_.inputs)),
                                preview_vertices);
          })),
      crowd_(crowd_of_job(job_)),
      prepared_(prepare(job_.config, job_.inputs, job_.smoothing, cache)),
      builder_(job_.config, job_.inputs, prepared_),
      faults_(job_, builder_),
      judging_data_(std::async(std::launch::async, [this] { return make_judging_data(); }).share()),
      casting_(casting_options(job_.config, job_.inputs,
                               job_.config.plane.layout == Layout::kSimilarity
                                   ? judging_data_.get().space->face_space.head_distances()
                                   : Eigen::MatrixXd())),
      preview_(preview_future_.get()),
      vertex_faces_(job_.inputs.head_set.topology),
      sky_visibility_(std::async(std::launch::async, [this] {
                        return vertex_visibility(job_.inputs.head_set.topology,
                                                 surfaces_of(job_.config, job_.inputs).kinds,
                                                 mean_head(job_.inputs.head_set),
                                                 preview_.vertices);
                      }).share()) {
  if (job_.config.smoothing.levels == LevelRepresentation::kExact) {
    preview_prepared_ =
        prepare(with_fitted_levels(job_.config), job_.inputs, job_.smoothing, cache);
  }
}

EditSession::JudgingData EditSession::make_judging_data() const {
  auto searched_space =
      std::make_unique<const CastingSpace>(casting_space(job_.config, job_.inputs, prepared_, {}));
  const FaceSpace& space = searched_space->face_space;
  NearestFaceSearch crowd(space.dimensions());
  if (crowd_) {
    std::vector<FaceSpace::Point> points(crowd_->size());
    parallel_for_each(points.size(),
                      [&](std::size_t i) { points[i] = space.point((*crowd_)[i].recipe); });
    for (const FaceSpace::Point& point : points) crowd.add(point);
  }
  FaceJudge judge(space, *job_.config.diversity, *job_.config.believability,
                  &searched_space->proxy_skin);
  auto traits = available_face_traits(job_.config, job_.inputs, prepared_);
  if (traits) judge.set_trait_rules(TraitRules(traits->measurer(), casting_));
  return {std::move(searched_space), std::move(judge), std::move(crowd), std::move(traits)};
}

std::vector<HeadSmoothing> EditSession::preview_levels() const {
  if (!preview_prepared_) return head_smoothings(job_.config, prepared_);
  return head_smoothings(with_fitted_levels(job_.config), *preview_prepared_);
}

Positions EditSession::build(const Recipe& recipe) const {
  const std::lock_guard lock(previous_face_mutex_);
  return builder_.rebuild(recipe, previous_face_);
}

void EditSession::use_masks(const RegionWeights& masks) {
  const std::lock_guard lock(previous_face_mutex_);
  builder_.use_masks(job_.config, masks);
  previous_face_ = {};
}

NearestFaceSearch::NearestFace EditSession::nearest_other_face(const FaceSpace::Point& point,
                                                               const FacePlan& recipe,
                                                               const std::string& opened_id) const {
  NearestFaceSearch::NearestFace nearest;
  const auto search = [&](Index begin, Index end) {
    if (begin == end) return;
    const auto found =
        judging_data_.get().crowd_search.nearest(point, nearest.distance_mm, begin, end);
    if (found.face >= 0) nearest = found;
  };
  Index begin = 0;
  for (const FacePlan& face : *crowd_) {
    if (face.id != recipe.id && face.id != opened_id) continue;
    const Index at = &face - crowd_->data();
    search(begin, at);
    begin = at + 1;
  }
  search(begin, static_cast<Index>(crowd_->size()));
  return nearest;
}

double EditSession::distance_mm(const FacePlan& one, const FacePlan& other) const {
  const FaceSpace& space = judging_data_.get().space->face_space;
  return FaceSpace::distance(space.point(one.recipe), space.point(other.recipe));
}

FaceMeasures EditSession::measure(const FacePlan& recipe, const std::string& opened_id) const {
  const JudgingData& judging = judging_data_.get();
  const FaceJudge& judge = judging.judge;
  const FaceSpace::Point point = judge.space().point(recipe.recipe);
  FaceMeasures measures;
  const NearestFaceSearch::NearestFace head = judge.nearest_head(point);
  measures.nearest_head = head.face;
  measures.nearest_head_distance_mm = head.distance_mm;
  measures.nearest_head_distance_with_extrapolation_mm =
      (point.coordinates_with_extrapolation -
       judge.space().head_point(head.face).coordinates_with_extrapolation)
          .norm();
  if (crowd_) {
    const NearestFaceSearch::NearestFace nearest = nearest_other_face(point, recipe, opened_id);
    if (nearest.face >= 0) {
      measures.nearest_face = static_cast<std::size_t>(nearest.face);
      measures.nearest_face_distance_mm = nearest.distance_mm;
    }
  }
  if (judging.traits)
    measure_traits(*judging.traits, *judging.judge.trait_rules(), recipe, measures);
  if (const auto why = judge.check_recipe(recipe.recipe, point)) {
    measures.warnings.push_back(sentence(*why, job_.config));
  }
  if (const auto why = judge.check_skin(recipe.recipe)) {
    measures.warnings.push_back(sentence(*why, job_.config));
  }
  return measures;
}

FaceMeasures EditSession::measure(const FacePlan& recipe, const Positions& face,
                                  const std::string& opened_id) const {
  FaceMeasures measures = measure(recipe, opened_id);
  if (job_.config.believability->check &&
      builder_.gap_excess_mm(recipe.recipe, face) > job_.config.believability->max_gap_mm) {
    measures.warnings.push_back(sentence(RejectionReason::kGap, job_.config));
  }
  return measures;
}

FacePlan EditSession::steer(FacePlan face, const std::string& trait, double wanted,
                            const std::vector<std::size_t>& locked_bands) const {
  const auto& traits = judging_data_.get().traits;
  const auto measured = traits ? traits->trait_indices() : std::vector<std::size_t>();
  const auto found = find_measurement(trait);
  const auto at = std::ranges::find(measured, found.value_or(measurements().size()));
  if (at == measured.end()) {
    throw UsageError(concat("trait: ", quoted(trait), " cannot be measured on these heads"));
  }
  if (casting_.normalization == Normalization::kPrinted) {
    throw UsageError(
        "blending.normalization: expected partition to change a measurement, found printed");
  }
  std::vector<SteeredBand> bands;
  const std::size_t count = band_count(casting_.sampling);
  for (std::size_t part = 0; part < count * face.recipe.regions.size(); ++part) {
    if (std::ranges::find(locked_bands, part) != locked_bands.end()) continue;
    SteeredBand band{part / count, part % count, sources_of(casting_.sampling, part % count)};
    for (const SourceWeight& lent : target_head_weights(face.recipe)) {
      band.heads.push_back(lent.head);
    }
    for (const SourceWeight& lent : band_of(face.recipe.regions[band.region], band.band).weights) {
      band.heads.push_back(lent.head);
    }
    std::ranges::sort(band.heads);
    band.heads.erase(std::unique(band.heads.begin(), band.heads.end()), band.heads.end());
    bands.push_back(std::move(band));
  }
  const auto number = static_cast<std::size_t>(at - measured.begin());
  face.recipe = steer_trait(std::move(face.recipe), bands, wanted,
                            [&](const Recipe& recipe) { return traits->values(recipe)[number]; });
  return face;
}

std::vector<FacePlan> EditSession::sample_faces(const SampleRequest& request) const {
  const JudgingData& judging = judging_data_.get();
  return crowdface::sample_faces(casting_, judging.judge, judging.crowd_search, request);
}

std::vector<float> EditSession::preview_points(const Positions& face) const {
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> shown =
      face(preview_.vertices, kAllColumns).cast<float>();
  return {shown.data(), shown.data() + shown.size()};
}

std::vector<std::uint8_t> EditSession::preview_roughness(const TextureSet& texture_set) const {
  std::vector<std::uint8_t> roughness;
  if (texture_set.roughness.texture_of_polygon.empty()) return roughness;
  const float plain = material_of(SurfaceKind::kSkin).roughness;
  for (std::size_t v = 0; v < preview_.vertices.size(); ++v) {
    const Eigen::Vector2f uv =
        textures_.cell_coordinates({preview_.uvs[2 * v], preview_.uvs[2 * v + 1]});
    const float rough =
        roughness_at(texture_set, {static_cast<Index>(preview_.face_of_vertex[v]), uv})
            .value_or(plain);
    roughness.push_back(static_cast<std::uint8_t>(std::lround(255 * rough)));
  }
  return roughness;
}

std::vector<float> EditSession::preview_normals(const Positions& face) const {
  constexpr std::size_t kBlock = 1024;
  std::vector<float> normals(3 * preview_.vertices.size());
  parallel_for_each(preview_.vertices.size(), kBlock, [&](std::size_t i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t f : vertex_faces_.items_of(preview_.vertices[i])) {
      sum += face_area_vector(job_.inputs.head_set.topology, f, face);
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
