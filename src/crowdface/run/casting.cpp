// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/casting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/cast/child_skin_colours.h"
#include "crowdface/cast/compared_area.h"
#include "crowdface/cast/feasibility.h"
#include "crowdface/cast/merge_reviews.h"
#include "crowdface/cast/sample_cells.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached_face_space.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/shared_by_heads.h"
#include "crowdface/run/changed_faces.h"
#include "crowdface/run/iris_cover.h"
#include "crowdface/run/mesh_judge.h"
#include "crowdface/run/scarcity_warning.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {
namespace {

std::vector<PlanePoint> lay_out(const Config& config, const Eigen::MatrixXd& head_distances) {
  const auto heads = static_cast<Index>(config.faces.names.size());
  std::vector<PlanePoint> anchors(static_cast<std::size_t>(heads), PlanePoint::Zero());
  switch (config.plane.layout) {
    case Layout::kCircle:
      anchors = circle_layout(heads);
      break;
    case Layout::kGrid:
      anchors = grid_layout(heads);
      break;
    case Layout::kSimilarity:
      anchors = similarity_layout(head_distances);
      break;
    case Layout::kManual:
      break;  // the config gives every head an anchor; the loop below sets these anchors
  }
  for (const auto& [head, anchor] : config.plane.anchors) {
    anchors[static_cast<std::size_t>(head)] = anchor;
  }
  return anchors;
}

/// Returns the matrix entries below the diagonal, row by row.
std::vector<double> below_diagonal(const Eigen::MatrixXd& distances) {
  std::vector<double> values;
  for (Index a = 0; a < distances.rows(); ++a) {
    for (Index b = 0; b < a; ++b) values.push_back(distances(a, b));
  }
  return values;
}

CrowdDistances measure_crowd_distances(const FaceSpace& space,
                                       const Eigen::MatrixXd& head_distances,
                                       const CastingResult& crowd_plan) {
  CrowdDistances distances;
  distances.between_heads = quartiles(below_diagonal(head_distances));
  distances.between_faces = quartiles(pair_distances(crowd_plan.points));
  if (distances.between_heads.median > 0) {
    distances.face_to_head_median_ratio =
        distances.between_faces.median / distances.between_heads.median;
  }
  const Index regions = space.heads_at_samples().region_weights.cols();
  for (Index k = 0; regions > 1 && k < regions; ++k) {
    distances.between_faces_by_region.push_back(
        quartiles(pair_distances(space, k, crowd_plan.points)));
  }
  std::vector<double> to_head, to_face;
  for (const FacePlan& face : crowd_plan.crowd) {
    to_head.push_back(face.notes.nearest->head_distance_mm);
    if (face.notes.nearest->earlier_face)
      to_face.push_back(face.notes.nearest->earlier_face_distance_mm);
  }
  distances.to_nearest_head = quartiles(std::move(to_head));
  distances.to_nearest_face = quartiles(std::move(to_face));
  return distances;
}

std::vector<FamilyReport> report_families(const Config& config, const CastingResult& crowd_plan) {
  std::vector<FamilyReport> reports;
  NearestFaceSearch index(
      crowd_plan.points.empty() ? 1 : crowd_plan.points[0].coordinates_with_extrapolation.size());
  for (const FaceSpace::Point& point : crowd_plan.points) index.add(point);
  for (std::size_t f = 0; f < crowd_plan.families.size(); ++f) {
    const FamilyPlan& family = crowd_plan.families[f];
    FamilyReport report;
    report.name = family.name;
    report.member_count = static_cast<std::uint64_t>(family.members_end - family.members_begin);
    const std::vector<FaceSpace::Point> members(crowd_plan.points.begin() + family.members_begin,
                                                crowd_plan.points.begin() + family.members_end);
    report.member_distances = quartiles(pair_distances(members));
    std::vector<double> founder_distances;
    double nearest = HUGE_VAL;
    for (const FaceSpace::Point& member : members) {
      founder_distances.push_back(FaceSpace::distance(member, family.founder_point));
      nearest =
          std::min(nearest, index.nearest(member, nearest, 0, family.members_begin).distance_mm);
      nearest = std::min(
          nearest, index.nearest(member, nearest, family.members_end, index.size()).distance_mm);
    }
    report.founder_distances = quartiles(std::move(founder_distances));
    report.nearest_outsider_mm = nearest < HUGE_VAL ? nearest : 0;
    if (!config.families[f].parents.empty())
      report.fraction_of_strangers_nearer_than_parent =
          family.fraction_of_strangers_nearer_than_parent;
    report.silhouette_coefficient =
        mean_silhouette_coefficient(crowd_plan.families, f, crowd_plan.points);
    reports.push_back(std::move(report));
  }
  return reports;
}

std::set<std::string> twin_families(const Config& config) {
  std::set<std::string> names;
  for (const FamilyOptions& family : config.families) {
    if (family.are_twins) names.insert(family.name);
  }
  return names;
}

/// The mean optical density of each head's colour textures; empty if faces have no blended colour
/// textures. Reads only one texel of each block of 16 by 16 texels.
std::vector<double> skin_tones(const Inputs& inputs) {
  constexpr int kStep = 16;
  if (!inputs.textures.are_blended()) return {};
  const HeadMaps& maps = inputs.textures.blended.maps;
  std::vector<double> tones(inputs.head_set.heads.size(), 0.0);
  parallel_for_each(tones.size(), [&](std::size_t h) {
    double sum = 0, count = 0;
    for (const auto& of_picture : maps) {
      const TextureMap* map = of_picture[h].get();
      if (map == nullptr) continue;
      for (int c = 0; c < map->coding.channels; ++c) {
        for (int y = kStep / 2; y < map->height; y += kStep) {
          const Density* row = map->row(c, y);
          for (int x = kStep / 2; x < map->width; x += kStep) {
            sum += row[x];
            ++count;
          }
        }
      }
    }
    if (count > 0) tones[h] = sum / count;
  });
  return tones;
}

/// Gives each child a skin tone between the tones of the parents.
void choose_skin(const Config& config, const Inputs& inputs, std::vector<FacePlan>& crowd) {
  const bool has_children =
      std::ranges::any_of(crowd, [](const FacePlan& face) { return !face.parents.empty(); });
  if (!has_children) return;
  std::vector<double> tones = skin_tones(inputs);
  if (tones.empty()) return;
  const std::vector<double> area_fractions = region_area_fractions(
      inputs.regions,
      compared_vertex_areas(inputs.head_set.topology, inputs.skin_components, inputs.mean_head,
                            ComparedArea::kFront, config.faces.front));
  choose_skin_colours_of_children(
      {config.crowd.seed, config.faces.names, config.faces.tags, std::move(tones),
       [&](const Recipe& recipe) {
         return face_colour_weights(recipe, inputs.head_set.heads.size(), area_fractions)
             .weights_for_skin;
       },
       twin_families(config)},
      crowd);
}

ColourOptions colour_options(const Config& config) {
  return {config.crowd.seed, config.faces.names, config.faces.tags, config.textures.matching_tags};
}

/// Rounds values to four decimals, as the plan file does, so that this run reports the same values
/// as a run that reads the plan file.
void round_as_planned(std::vector<FacePlan>& crowd) {
  for (FacePlan& face : crowd) {
    face.mother_share = rounded(face.mother_share);
    NearestNeighbours& nearest = *face.notes.nearest;
    nearest.head_distance_mm = rounded(nearest.head_distance_mm);
    nearest.earlier_face_distance_mm = rounded(nearest.earlier_face_distance_mm);
  }
}

/// Returns the age of each head in years; nothing if any age is unknown.
std::vector<double> ages_of_heads(const Config& config) {
  std::vector<double> ages;
  for (const auto& age : config.faces.ages_years) {
    if (!age) return {};
    ages.push_back(*age);
  }
  return ages;
}

/// Returns options for trial castings with other minimum distances. The faces that already exist in
/// the crowd's folder keep their own minimum distance in these trials.
CastingOptions with_existing_faces(const Config& config, CastingOptions casting) {
  if (config.crowd.existing_face_count) {
    casting.diversity.min_distance_mm_up_to_face.try_emplace(*config.crowd.existing_face_count,
                                                             casting.diversity.min_distance_mm);
  }
  return casting;
}

}  // namespace

CastingSpace casting_space(const Config& config, const Inputs& inputs,
                           const PreparedHeads& prepared, const std::filesystem::path& cache) {
  const std::vector<double> areas = compared_vertex_areas(
      inputs.head_set.topology, inputs.skin_components, mean_before_placement(inputs),
      config.distance.area, config.faces.front, inputs.distance_weights);
  const SampleCells cells = find_cells(inputs, prepared.samples);
  HeadsAtSamples heads =
      sample_heads(inputs.head_set, inputs.regions, prepared.samples, prepared.trajectories,
                   inputs.max_level, mm_per(config.faces.units));
  if (inputs.mirror_map != nullptr) {
    heads.mirror_images =
        sample_mirror_images(inputs.head_set, inputs.regions, *inputs.mirror_map, prepared.samples,
                             prepared.trajectory_samples, heads);
  }
  FaceSpace space =
      cached_face_space(cache, std::move(heads), sample_weights(cells, prepared.samples, areas),
                        band_count(*config.sampling));
  ProxySkin skin(cell_triangles(inputs.head_set.topology, cells), space.heads_at_samples().mean,
                 space.heads_at_samples().heads);
  return {std::move(space), std::move(skin)};
}

CastingOptions casting_options(const Config& config, const Inputs& inputs,
                               const Eigen::MatrixXd& head_distances) {
  return {config.crowd.name,
          config.crowd.count,
          config.crowd.seed,
          lay_out(config, head_distances),
          config.region_names(),
          *config.sampling,
          config.recipes,
          config.blending.normalization,
          level_scale(config, inputs),
          *config.diversity,
          config.families,
          merged_reviews(config.review.reviews).reviews,
          config.groups,
          config.faces.tags,
          config.population.targets,
          config.changes,
          ages_of_heads(config)};
}

AttachmentOptions attachment_options(const Config& config) {
  const Config::Attachments& placed = config.attachments;
  AttachmentOptions draw{config.crowd.seed,
                         {placed.items.begin(), placed.items.end()},
                         {{"", placed.fraction_without_item_by_kind}},
                         config.faces.tags,
                         placed.quotas,
                         config.faces.names};
  draw.hair_colours[""] = placed.hair_colours;
  for (const Group& group : config.groups) {
    draw.fractions_without_item[group.name] = group.fraction_without_item_by_kind;
    if (!group.hair_colours.empty()) draw.hair_colours[group.name] = group.hair_colours;
  }
  draw.twin_families = twin_families(config);
  return draw;
}

CrowdPlan plan_crowd(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
                     const std::function<const FaceBuilder&()>& builder,
                     FaceAttachments& bound_attachments, const std::filesystem::path& cache) {
  const CastingSpace judged_in = casting_space(config, inputs, prepared, cache);
  const FaceSpace& space = judged_in.face_space;
  const Eigen::MatrixXd head_distances = space.head_distances();
  const CastingOptions casting = casting_options(config, inputs, head_distances);
  for (const std::string& conflict : merged_reviews(config.review.reviews).conflicts) {
    log_warning(concat("reviews made at the same time disagree about ", conflict));
  }
  FaceJudge judge(space, casting.diversity, *config.believability, &judged_in.proxy_skin,
                  casting_builds_candidate_meshes(config)
                      ? mesh_defect_finder(config, inputs, builder())
                      : MeshDefectFinder());
  const auto traits = face_traits_of_config(config, inputs, prepared);
  if (traits) judge.set_trait_rules(TraitRules(traits->measurer(), casting));
  CastingResult crowd;
  crowd.shortfall = shortfall_if_spread_impossible(casting, judge);
  if (!crowd.shortfall) {
    Progress progress("casting", casting.count, kFacesCastInParallel);
    ScarcityWarning warning(casting);
    crowd = cast_crowd(casting, judge, [&](const RejectionCounts& thrown) {
      progress.step();
      warning.on_face_accepted(thrown);
    });
  }
  if (crowd.shortfall) {
    constexpr std::size_t kMaxTrials = 20;
    Progress progress("searching for values that work", kMaxTrials);
    const Remedy remedy = find_remedy(with_existing_faces(config, casting), judge, *crowd.shortfall,
                                      [&] { progress.step(); });
    std::vector<std::string> trait_advice_lines;
    if (remedy.binding_constraint == RejectionReason::kTraits) {
      trait_advice_lines = trait_advice(config, inputs, casting, *traits, *crowd.shortfall);
    }
    throw_shortfall(config, remedy, *crowd.shortfall, trait_advice_lines);
  }
  std::map<std::size_t, std::optional<NearestNeighbours>> nearest_to_unchanged;
  for (const auto& [face, changed] : crowd.changed) {
    crowd.points[face] = changed.point;
    nearest_to_unchanged[face] =
        std::exchange(crowd.crowd[face].notes.nearest, changed.face.notes.nearest);
    crowd.crowd[face].notes.changes = changed.face.notes.changes;
  }
  CrowdPlan result;
  result.distances = measure_crowd_distances(space, head_distances, crowd);
  result.families = report_families(config, crowd);
  result.anchors = casting.anchors;
  result.crowd = std::move(crowd.crowd);
  round_as_planned(result.crowd);
  if (config.textures.colours == ColourWeights::kSampled) {
    choose_colours(colour_options(config), result.crowd);
  }
  AttachmentOptions attachments = attachment_options(config);
  IrisCover iris_cover(config, inputs, bound_attachments, builder);
  attachments.covers_eyes = [&](const std::string& item, const FacePlan& face) {
    return iris_cover.covered_fraction(item, face) > IrisCover::kMaxCoveredFraction;
  };
  if (!config.attachments.items.empty()) {
    // Choose attachments for the crowd without changes, because a change of one face must not
    // change the attachments of another face.
    const auto swap_nearest = [&] {
      for (auto& [face, nearest] : nearest_to_unchanged)
        std::swap(result.crowd[face].notes.nearest, nearest);
    };
    swap_nearest();
    choose_attachments(attachments, crowd.group_indices, result.crowd, crowd.rejected,
                       crowd.crowd_size_at_rejection);
    swap_nearest();
  }
  choose_skin(config, inputs, result.crowd);
  replace_changed_faces(config, casting, attachments, colour_options(config), crowd.group_indices,
                        crowd.changed, result.crowd);
  if (traits) {
    measure_faces(*traits, result.crowd);
    measure_faces(*traits, crowd.rejected);
    result.traits = report_traits(casting, *traits, result.crowd);
  }
  for (FamilyPlan& family : crowd.families) {
    const auto member = std::ranges::find(result.crowd, family.name, &FacePlan::family);
    if (member != result.crowd.end()) {
      family.founder.recipe.colours = member->recipe.colours;
    }
    family.founder.id = concat(family.name, "_founder");
    family.founder.family = family.name;
    result.founders.push_back(std::move(family.founder));
  }
  // Keep the faces' points in the casting space only if a later stage needs these points. A million
  // points take a gigabyte.
  if (config.output.contact_sheet || !config.groups.empty()) {
    result.points = std::move(crowd.points);
  }
  result.group_of_face = std::move(crowd.group_indices);
  result.rejected = std::move(crowd.rejected);
  result.rejections = crowd.rejections;
  return result;
}

}  // namespace crowdface
