// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/sample_faces.h"

#include <algorithm>
#include <map>

#include "crowdface/cast/band_order.h"
#include "crowdface/cast/mixed_recipe.h"
#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

double between(double a, double b, double share) {
  return a + share * (b - a);
}

/// Interpolates between the values that two recipes have for the same band.
/// \param share    0: result `a`; 1: result `b`
/// \param sources  heads that may contribute to the band
BandRecipe between(const BandRecipe& a, const BandRecipe& b, double share, Index target,
                   const std::vector<Index>& sources, const CastingOptions& casting) {
  BandRecipe band;
  if (a.position && b.position) {
    band.position = *a.position + share * (*b.position - *a.position);
    band.weights = weights_at_position(casting.anchors, target, sources, *band.position,
                                       casting.normalization, casting.sampling.max_sources);
  } else {
    band.weights = mixed_weights(a.weights, b.weights, share);
  }
  band.smoothness = between(a.smoothness, b.smoothness, share);
  band.iterations = iterations_of(band.smoothness, casting.level_scale);
  band.extrapolation = between(a.extrapolation, b.extrapolation, share);
  return band;
}

FacePlan sample_one(const CastingOptions& casting, const SampleRequest& request,
                    std::uint32_t attempt) {
  const bool keeps_target = request.original || !request.locked_bands.empty();
  const FacePlan& old = request.original ? *request.original : request.start_face;
  ManualRecipe open;
  open.id = request.start_face.id;
  open.age = AgeRange{};
  if (keeps_target) open.target = old.recipe.target;
  FacePlan face = random_face_plan(casting, open, {0, attempt, concat("edit/", open.id)},
                                   distribution_of_group(casting));
  if (keeps_target) {
    face.recipe.mixture = old.recipe.mixture;
    face.recipe.colours = old.recipe.colours;
    face.recipe.asymmetry = old.recipe.asymmetry;
    face.recipe.mirrored = old.recipe.mirrored;
  }
  for (std::size_t k = 0; k < face.recipe.regions.size() && request.original; ++k) {
    RegionRecipe& region = face.recipe.regions[k];
    for (std::size_t b = 0; b < band_count(region); ++b) {
      BandRecipe& band = band_of(region, b);
      band = between(band_of(request.original->recipe.regions[k], b), band, request.variation,
                     face.recipe.target, sources_of(casting.sampling, b), casting);
    }
  }
  copy_bands(request.locked_bands, request.start_face.recipe, face.recipe);
  return face;
}

}  // namespace

std::vector<FacePlan> sample_faces(const CastingOptions& casting, const FaceJudge& judge,
                                   const NearestFaceSearch& crowd, const SampleRequest& request) {
  constexpr std::uint32_t kAttemptsEach = 40;
  const auto most = static_cast<std::uint32_t>(request.count) * kAttemptsEach;
  std::vector<FacePlan> faces;
  std::map<RejectionReason, std::uint32_t> reasons;
  for (std::uint32_t i = 0; i < most && faces.size() < request.count; ++i) {
    throw_if_interrupted();
    FacePlan face = sample_one(casting, request, request.first_attempt + i);
    if (judge.check_traits(face, judge.landmarks(face.recipe)) || judge.check_traits(face)) {
      ++reasons[RejectionReason::kTraits];
      continue;
    }
    const FaceSpace::Point point = judge.space().point(face.recipe);
    std::optional<RejectionReason> why = judge.check_recipe(face.recipe, point);
    const double least = casting.diversity.min_distance_mm;
    if (!why && !request.original && least > 0 && crowd.nearest(point, least).face >= 0) {
      why = RejectionReason::kMinDistance;
    }
    if (!why) why = judge.check_skin(face.recipe);
    if (why) {
      ++reasons[*why];
    } else {
      faces.push_back(std::move(face));
    }
  }
  if (!faces.empty() || request.count == 0) return faces;
  const auto main = std::ranges::max_element(
      reasons, [](const auto& a, const auto& b) { return a.second < b.second; });
  throw Unsatisfiable(concat("none of ", most, " drawn faces meets the limits of the config; ",
                             main->second, " of them violate ", name_of(main->first)));
}

}  // namespace crowdface
