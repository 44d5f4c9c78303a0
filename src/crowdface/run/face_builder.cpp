// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_builder.h"

#include <algorithm>
#include <set>
#include <utility>

#include "crowdface/blend/blend.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/head_mirror.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/named_parts.h"

namespace crowdface {
namespace {

/// A contact is a pair of skin surfaces that almost touch, such as the lips. Returns, for each
/// contact, the mean region weights of the points on both surfaces. Result: #contacts by #regions;
/// each row sums to one.
std::vector<std::vector<double>> contact_masks(const SkinContacts& contacts,
                                               const RegionWeights& regions) {
  std::vector<std::vector<double>> masks;
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    std::vector<double> mask(static_cast<std::size_t>(regions.alpha.cols()), 0.0);
    const GapSection& section = contacts.section(p);
    for (const auto* profile : {&section.low_profile, &section.high_profile}) {
      const double share = 0.5 / static_cast<double>(profile->size());
      for (const EdgePoint& point : *profile) {
        for (std::size_t k = 0; k < mask.size(); ++k) {
          mask[k] += share * regions.alpha(point.a, static_cast<Index>(k));
        }
      }
    }
    masks.push_back(std::move(mask));
  }
  return masks;
}

}  // namespace

FaceBuilder::FaceBuilder(const Config& config, const Inputs& inputs, const PreparedHeads& prepared)
    : config_(config),
      inputs_(inputs),
      prepared_(prepared),
      corrects_contacts_(config.blending.contacts == ContactHandling::kAuto),
      mm_per_unit_(mm_per(config.faces.units)) {
  BackgroundTasks beside;  // finds the contacts in parallel with the work on the parts
  beside.run([&] { contacts_.emplace(inputs.head_set, inputs.adjacency, skin_vertices(inputs)); });
  if (!inputs.parts.parts.empty()) {
    follower_.emplace(inputs.head_set, inputs.parts, head_axes(config), config.parts.shape);
  }
  beside.wait();
  use_masks(config, inputs.regions);
}

void FaceBuilder::use_masks(const Config& config, const RegionWeights& regions) {
  regions_ = regions;
  contact_masks_ = contact_masks(*contacts_, regions);
  if (config.parts.shape == PartShape::kTarget) {
    for (const Part& part : inputs_.parts.parts) {
      for (const std::uint32_t v : part.vertices) regions_.alpha.row(v).setZero();
    }
  }
  poses_.reset();
  if (inputs_.heads_on_body && inputs_.heads_on_body->has_differing_poses())
    poses_.emplace(inputs_, prepared_, regions);
  if (config.smoothing.levels != LevelRepresentation::kExact) {
    blender_.emplace(inputs_.head_set, head_smoothings(config, prepared_),
                     prepared_.patches.patches, regions_);
  }
}

void FaceBuilder::build(std::span<const Recipe* const> recipes,
                        std::span<Positions> results) const {
  if (blender_) {
    blender_->blend(recipes, results);
  } else {
    blend_exact(inputs_.head_set, *prepared_.filter, regions_, recipes, results);
  }
  throw_if_truncated(prepared_);
  parallel_for_each(recipes.size(), [&](std::size_t f) { finish(*recipes[f], results[f]); });
}

Positions FaceBuilder::build(const Recipe& recipe) const {
  const Recipe* one = &recipe;
  Positions face;
  build({&one, 1}, {&face, 1});
  return face;
}

Positions FaceBuilder::rebuild(const Recipe& recipe, PreviousFace& previous) const {
  if (!blender_) return build(recipe);
  // Clear the previous face before the update, so that an exception cannot leave a half-updated
  // face.
  if (const auto before = std::exchange(previous.recipe, std::nullopt)) {
    blender_->update(*before, recipe, previous.blended_positions);
  } else {
    previous.blended_positions = blender_->blend(recipe);
  }
  throw_if_truncated(prepared_);
  previous.recipe = recipe;
  Positions face = previous.blended_positions;
  finish(recipe, face);
  return face;
}

void FaceBuilder::finish(const Recipe& recipe, Positions& face) const {
  if (recipe.asymmetry != 1) {
    face = blend_with_mirrored(face, mirrored(mirror(), face),
                               mirror_image_weight(recipe.asymmetry, false));
  }
  correct_contacts(recipe, face);
  if (follower_) follower_->move_parts(recipe.target, face);
  if (const auto turn = motion_to_body(recipe)) move_rows(*turn, face);
  if (recipe.mirrored) face = mirrored(mirror(), face);
  if (inputs_.heads_on_body) inputs_.heads_on_body->seam.bend_to_seam(face);
}

std::optional<RigidMotion> FaceBuilder::motion_to_body(const Recipe& recipe) const {
  if (!poses_) return std::nullopt;
  return poses_->motion_of(recipe, is_unmirrored(recipe) ? nullptr : &mirror().plane);
}

std::vector<std::uint32_t> FaceBuilder::contact_vertices() const {
  std::set<std::uint32_t> vertices;
  for (std::size_t p = 0; corrects_contacts_ && p < contacts_->size(); ++p) {
    const GapSection& section = contacts_->section(p);
    for (const auto* profile : {&section.low_profile, &section.high_profile}) {
      for (const EdgePoint& point : *profile) vertices.insert({point.a, point.b});
    }
  }
  return {vertices.begin(), vertices.end()};
}

void FaceBuilder::correct_contacts(const Recipe& recipe, Positions& face) const {
  if (corrects_contacts_) contacts_->fit_gaps(contact_ranges(recipe), face);
}

const MirrorMap& FaceBuilder::mirror() const {
  std::call_once(mirror_once_,
                 [&] { mirror_ = required_mirror_map(config_, inputs_, "a recipe"); });
  return *mirror_;
}

SkinDefects FaceBuilder::defects(const SkinCheck& check, const Recipe& recipe,
                                 const Positions& face) const {
  std::optional<Positions> mixed;  // the target shape; empty if a head itself is the target
  if (!recipe.mixture.empty() || recipe.asymmetry != 1) {
    mixed = target_positions(inputs_.head_set, recipe);
    if (recipe.asymmetry != 1) {
      mixed = blend_with_mirrored(*mixed, mirrored(mirror(), *mixed),
                                  mirror_image_weight(recipe.asymmetry, false));
    }
  }
  const Positions& target =
      mixed ? *mixed : inputs_.head_set.heads[static_cast<std::size_t>(recipe.target)].positions;
  Positions judged = face;
  const auto turn = motion_to_body(recipe);
  if (inputs_.heads_on_body) {  // the bend at the neck is not a defect
    Positions like = target;
    if (turn) move_rows(*turn, like);
    inputs_.heads_on_body->seam.bend_to_rim_of(recipe.mirrored ? mirrored(mirror(), like) : like,
                                               judged);
  }
  if (recipe.mirrored) judged = mirrored(mirror(), judged);
  if (turn) move_rows(inverse(*turn), judged);
  SkinDefects defects =
      mixed ? check.compare(judged, *mixed) : check.compare(judged, recipe.target);
  defects.gap_excess_mm = contacts_->max_gap_excess(judged) * mm_per_unit_;
  return defects;
}

std::vector<SkinContacts::Range> FaceBuilder::contact_ranges(const Recipe& recipe) const {
  std::vector<SkinContacts::Range> ranges;
  std::size_t bands = 1;
  for (const RegionRecipe& region : recipe.regions) bands = std::max(bands, band_count(region));
  for (std::size_t p = 0; p < contacts_->size(); ++p) {
    double of_target = 0;
    for (const SourceWeight& share : target_head_weights(recipe)) {
      of_target += share.weight * contacts_->head_gaps(share.head)[p];
    }
    SkinContacts::Range range{of_target, of_target};
    for (std::size_t b = 0; b < bands; ++b) {  // a gap may come from the sources of any band
      double of_sources = 0;
      for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
        const RegionRecipe& region = recipe.regions[k];
        double sum = 0, weights = 0;
        for (const SourceWeight& source :
             band_of(region, std::min(b, band_count(region) - 1)).weights) {
          sum += source.weight * contacts_->head_gaps(source.head)[p];
          weights += source.weight;
        }
        of_sources += contact_masks_[p][k] * (weights > 0 ? sum / weights : of_target);
      }
      range = {std::min(range.min, of_sources), std::max(range.max, of_sources)};
    }
    ranges.push_back(range);
  }
  if (recipe.asymmetry != 1) include_mirrored_gap_ranges(ranges);
  return ranges;
}

/// Extends the allowed range of each contact's gap to include the range of the mirrored contact,
/// because a face whose asymmetry is not 1 combines both sides.
void FaceBuilder::include_mirrored_gap_ranges(std::vector<SkinContacts::Range>& ranges) const {
  const std::vector<SkinContacts::Range> own = ranges;
  for (std::size_t p = 0; p < own.size(); ++p) {
    const Eigen::Vector3d image = mirror().plane.mirrored(contacts_->section(p).middle);
    std::size_t other = p;
    double nearest = HUGE_VAL;
    for (std::size_t q = 0; q < own.size(); ++q) {
      const double distance = (contacts_->section(q).middle - image).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      other = q;
    }
    ranges[p] = {std::min(own[p].min, own[other].min), std::max(own[p].max, own[other].max)};
  }
}

double FaceBuilder::gap_excess_mm(const Recipe& recipe, const Positions& face) const {
  const double units = recipe.mirrored ? contacts_->max_gap_excess(mirrored(mirror(), face))
                                       : contacts_->max_gap_excess(face);
  return units * mm_per_unit_;
}

std::uint64_t FaceBuilder::memory_bytes(std::size_t face_count) const {
  const auto vertices = static_cast<std::uint64_t>(inputs_.head_set.topology.vertex_count);
  std::uint64_t bytes_per_face = 3 * sizeof(double) * vertices;
  if (!blender_) {
    // Memory per region: the filter's input (once as a matrix and once as rows in the filter's
    // order), four vectors of the filter's recurrence, and one sum.
    const auto regions = static_cast<std::uint64_t>(inputs_.regions.alpha.cols());
    bytes_per_face += regions * vertices * (3 * sizeof(double) + 6 * sizeof(Row<double>));
  }
  // number of meshes per face that are in memory while asymmetry is adjusted: the face, its mirror
  // image, and the weighted mean of both
  constexpr std::uint64_t kMeshesPerFace = 3;
  if (inputs_.mirror_map != nullptr)
    bytes_per_face += (kMeshesPerFace - 1) * 3 * sizeof(double) * vertices;
  return face_count * bytes_per_face;
}

}  // namespace crowdface
