// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/draw_recipe.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/ageing.h"
#include "crowdface/cast/band_order.h"
#include "crowdface/cast/face_ids.h"
#include "crowdface/core/random.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/plane/layout.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

/// Number of random numbers (lanes) that are reserved for each try of random_position.
constexpr std::uint32_t kRandomLanesPerPosition = 64;
/// If a position gives one head too much weight, casting tries another position, at most
/// kPositionRetries times. PositionDistribution::pull limits how far a position is from the anchor.
/// Each retry raises this limit by kFartherEachTime.
constexpr std::uint32_t kPositionRetries = 20;
constexpr double kFartherEachTime = 0.1;

/// Random numbers of one face. Each number depends only on the face's key and on the purpose for
/// which the number is used.
class FaceRandom {
 public:
  FaceRandom(std::uint64_t seed, const FaceRandomKey& key) : seed_(seed), key_(key) {}

  std::array<double, 2> pair(std::string_view what, std::string_view region,
                             std::uint32_t lane = 0) const {
    const std::string purpose = key_.purpose_prefix.empty()
                                    ? concat(what, '/', region)
                                    : concat(key_.purpose_prefix, '/', what, '/', region);
    return random_pair({seed_, key_.index, purpose, key_.attempt}, lane);
  }
  double unit(std::string_view what, std::string_view region) const {
    return pair(what, region)[0];
  }
  double in(const Range& range, std::string_view what, std::string_view region) const {
    return range.low + (range.high - range.low) * unit(what, region);
  }

 private:
  std::uint64_t seed_;
  const FaceRandomKey& key_;
};

/// Returns a uniform random point in the unit disc: takes points in the square until one lies in
/// the disc. (A formula with sine and cosine would give different bits with different libraries.)
/// The probability of 64 misses is below 10⁻⁴²; in this case, returns the centre.
PlanePoint random_in_disc(const FaceRandom& draws, const std::string& region, std::uint32_t first) {
  for (std::uint32_t lane = 0; lane < 64; ++lane) {
    const auto [u, v] = draws.pair("position", region, first + lane);
    PlanePoint point(2 * u - 1, 2 * v - 1);
    if (point.x() * point.x() + point.y() * point.y() <= 1) return point;
  }
  return PlanePoint::Zero();
}

/// Returns a uniform random point in the convex hull of the sources' anchors.
PlanePoint random_in_hull(const CastingOptions& casting, const std::vector<Index>& sources,
                          const FaceRandom& draws, const std::string& region, std::uint32_t first) {
  std::vector<PlanePoint> anchors;
  for (const Index head : sources) {
    anchors.push_back(casting.anchors[static_cast<std::size_t>(head)]);
  }
  const auto [pick, a] = draws.pair("position", region, first);
  const double b = draws.pair("position", region, first + 1)[0];
  return sample_polygon(convex_hull(std::move(anchors)), pick, a, b);
}

/// \param retry  Number of earlier tries, which gave one head too much weight. Each retry allows a
///               larger distance from the anchor.
PlanePoint random_position(const CastingOptions& casting, const PositionDistribution& distribution,
                           const std::vector<Index>& sources, Index target, const FaceRandom& draws,
                           const std::string& region, std::uint32_t retry) {
  require(!sources.empty(), "a position is drawn among sources, and there is none");
  const std::uint32_t first = kRandomLanesPerPosition * retry;
  switch (distribution.kind) {
    case PositionDistribution::Kind::kFixed:
      return distribution.at;
    case PositionDistribution::Kind::kAround: {
      const Index head = distribution.head.value_or(target);
      return casting.anchors[static_cast<std::size_t>(head)] +
             distribution.radius * random_in_disc(draws, region, first);
    }
    case PositionDistribution::Kind::kUniform:
      return random_in_hull(casting, sources, draws, region, first);
    case PositionDistribution::Kind::kAnchored:
      break;
  }
  const auto [which, how_far] = draws.pair("position", region, first + 2);
  const auto at = static_cast<std::size_t>(which * static_cast<double>(sources.size()));
  const Index head = sources[std::min(at, sources.size() - 1)];
  const PlanePoint anchor = casting.anchors[static_cast<std::size_t>(head)];
  const double step =
      how_far * std::min(distribution.pull + kFartherEachTime * static_cast<double>(retry), 1.0);
  return anchor + step * (random_in_hull(casting, sources, draws, region, first) - anchor);
}

void draw_smoothness(const SmoothnessDistribution& distribution, const SmoothingLevelScale& scale,
                     const FaceRandom& draws, const std::string& region, BandRecipe& recipe) {
  const double drawn = draws.in(distribution.range, "smoothness", region);
  switch (distribution.unit) {
    case SmoothnessDistribution::Unit::kFraction:
      recipe.smoothness = drawn;
      recipe.iterations = iterations_of(drawn, scale);
      return;
    case SmoothnessDistribution::Unit::kIterations:
      recipe.iterations = static_cast<std::uint64_t>(std::round(drawn));
      break;
    case SmoothnessDistribution::Unit::kSize:
      recipe.iterations =
          drawn > 0 ? iterations_for_wavelength(scale.operator_kind, drawn, scale.edge_length_mm)
                    : 0;
      break;
  }
  recipe.iterations = std::min(recipe.iterations, scale.max_level);
  recipe.smoothness = static_cast<double>(recipe.iterations) / static_cast<double>(scale.max_level);
}

double largest_weight(const BandRecipe& band) {
  double largest = 0;
  for (const SourceWeight& source : band.weights) largest = std::max(largest, source.weight);
  return largest;
}

/// The distributions from which one band is drawn. The band's own values override the region's
/// values.
struct BandDistributions {
  std::string name;  ///< name of the region; for bands after the first: "region/band"
  std::size_t band = 0;
  RegionSampling sampling;
  ManualRecipe::Band manual;
};

BandDistributions band_draw(const CastingOptions& casting, const SamplingOptions& all,
                            std::size_t k, std::size_t b, const ManualRecipe::Region& region) {
  BandDistributions draw{casting.region_names[k], b, all.regions[k], {}};
  if (!all.bands.empty()) {
    const BandSampling& band = all.bands[b];
    const BandSampling::Region& own = band.regions[k];
    draw.sampling.position = own.position.value_or(draw.sampling.position);
    draw.sampling.smoothness = own.smoothness.value_or(draw.sampling.smoothness);
    draw.sampling.extrapolation = own.extrapolation.value_or(draw.sampling.extrapolation);
    if (b > 0) draw.name += concat('/', band.name);
  }
  if (!region.bands.empty()) draw.manual = region.bands[b];
  ManualRecipe::Band& manual = draw.manual;
  if (!manual.position && manual.weights.empty()) {
    manual.position = region.position;
    manual.weights = region.weights;
  }
  if (!manual.smoothness && b == 0) manual.smoothness = region.smoothness;
  if (!manual.extrapolation) manual.extrapolation = region.extrapolation;
  return draw;
}

/// Returns a band with the values of the hand-written recipe, and with random values where the
/// recipe has none. For a sampled face, all values are random.
BandRecipe random_band(const CastingOptions& casting, const FaceDistribution& distribution,
                       Index target, const FaceRandom& draws, const BandDistributions& draw) {
  const SamplingOptions& all = *distribution.sampling;
  const std::vector<Index>& sources = sources_of(distribution, draw.band);
  const ManualRecipe::Band& manual = draw.manual;
  BandRecipe recipe;
  const auto set_position = [&](const PlanePoint& position) {
    recipe.position = position;
    recipe.weights = weights_at_position(casting.anchors, target, sources, position,
                                         casting.normalization, all.max_sources);
  };
  const auto set_random_position = [&](std::uint32_t retry) {
    set_position(
        random_position(casting, draw.sampling.position, sources, target, draws, draw.name, retry));
  };
  if (!manual.weights.empty()) {
    recipe.weights = normalized_source_weights(manual.weights);
  } else if (manual.position) {
    set_position(*manual.position);
  } else {
    set_random_position(0);
    for (std::uint32_t retry = 1;
         retry <= kPositionRetries && largest_weight(recipe) > casting.diversity.max_weight;
         ++retry) {
      set_random_position(retry);
    }
  }
  draw_smoothness(manual.smoothness.value_or(draw.sampling.smoothness), casting.level_scale, draws,
                  draw.name, recipe);
  recipe.extrapolation = draws.in(manual.extrapolation.value_or(draw.sampling.extrapolation),
                                  "extrapolation", draw.name);
  return recipe;
}

RegionRecipe draw_region(const CastingOptions& casting, const FaceDistribution& distribution,
                         std::size_t k, Index target, const FaceRandom& draws,
                         const ManualRecipe::Region& manual) {
  const SamplingOptions& all = *distribution.sampling;
  RegionRecipe recipe;
  recipe.finer_bands.resize(band_count(all) - 1);
  for (std::size_t b = 0; b < band_count(all); ++b) {
    band_of(recipe, b) =
        random_band(casting, distribution, target, draws, band_draw(casting, all, k, b, manual));
  }
  restore_level_order(recipe);
  return recipe;
}

/// Returns the targets that suit an age in years: the targets whose age differs by at most 15
/// years, but at least the three targets nearest in age.
std::vector<WeightedHead> targets_of_age(double years, std::vector<WeightedHead> targets,
                                         const std::vector<double>& ages_years) {
  constexpr double kMaxDifferenceYears = 15;
  constexpr std::size_t kFewest = 3;
  if (targets.size() <= kFewest) return targets;
  const auto difference = [&](const WeightedHead& target) {
    return std::abs(ages_years[static_cast<std::size_t>(target.head)] - years);
  };
  std::vector<double> differences;
  for (const WeightedHead& target : targets) differences.push_back(difference(target));
  std::ranges::sort(differences);
  const double most = std::max(kMaxDifferenceYears, differences[kFewest - 1]);
  std::erase_if(targets, [&](const WeightedHead& target) { return difference(target) > most; });
  return targets;
}

Index random_target(const std::vector<WeightedHead>& targets, const Age& age,
                    const std::vector<double>& ages_years, double random_number) {
  if (age.unit == AgeUnit::kFraction)
    return weighted_choice(targets, random_number, &WeightedHead::weight).head;
  return weighted_choice(targets_of_age(age.value, targets, ages_years), random_number,
                         &WeightedHead::weight)
      .head;
}

}  // namespace

const SamplingOptions& sampling_of(const CastingOptions& casting,
                                   const std::optional<std::string>& group) {
  const auto own =
      group ? std::ranges::find(casting.groups, *group, &Group::name) : casting.groups.end();
  return own == casting.groups.end() ? casting.sampling : own->sampling;
}

std::uint64_t iterations_of(double smoothness, const SmoothingLevelScale& scale) {
  return static_cast<std::uint64_t>(std::round(smoothness * static_cast<double>(scale.max_level)));
}

std::vector<SourceWeight> normalized_source_weights(const std::vector<WeightedHead>& written) {
  std::vector<SourceWeight> weights;
  for (const WeightedHead& source : written) weights.push_back({source.head, source.weight});
  return normalized_weights(std::move(weights));
}

const std::vector<Index>& sources_of(const FaceDistribution& distribution, std::size_t band) {
  const bool own = band < distribution.sources.size() && !distribution.sources[band].empty();
  return own ? distribution.sources[band] : sources_of(*distribution.sampling, band);
}

FaceDistribution distribution_of_group(const CastingOptions& casting,
                                       std::optional<std::size_t> group) {
  if (!group) return {&casting.sampling, casting.sampling.targets, std::nullopt};
  const Group& own = casting.groups[*group];
  return {&own.sampling, own.sampling.targets, own.name};
}

std::vector<FaceDistribution> face_distributions(const CastingOptions& casting) {
  std::vector<FaceDistribution> kinds = {distribution_of_group(casting)};
  for (std::size_t g = 0; g < casting.groups.size(); ++g) {
    kinds.push_back(distribution_of_group(casting, g));
  }
  return kinds;
}

FacePlan random_face_plan(const CastingOptions& casting, const ManualRecipe& manual,
                          const FaceRandomKey& key, const FaceDistribution& distribution) {
  const FaceRandom draws(casting.seed, key);
  const SamplingOptions& sampling = *distribution.sampling;
  FacePlan face;
  face.id = manual.id;
  face.group = distribution.group;
  face.notes.attempt = key.attempt;
  require(manual.target || !distribution.targets.empty(),
          "a recipe is drawn on targets, and there is none");
  const AgeRange ages = manual.age.value_or(sampling.age);
  const Age age = {draws.in(ages.range, "age", ""), ages.unit};
  face.recipe.target = manual.target
                           ? *manual.target
                           : random_target(distribution.targets, age, casting.head_ages_years,
                                           draws.unit("target", ""));
  for (std::size_t k = 0; k < casting.region_names.size(); ++k) {
    const ManualRecipe::Region& region =
        k < manual.regions.size() ? manual.regions[k] : ManualRecipe::Region{};
    face.recipe.regions.push_back(
        draw_region(casting, distribution, k, face.recipe.target, draws, region));
  }
  if (!manual.colours.empty()) face.recipe.colours = normalized_source_weights(manual.colours);
  apply_age(face, age, casting);
  face.recipe.asymmetry = draws.in(manual.asymmetry.value_or(sampling.asymmetry), "asymmetry", "");
  face.recipe.mirrored = manual.mirrored.value_or(sampling.mirror == Mirroring::kRandom &&
                                                  draws.unit("mirror", "") < 0.5);
  return face;
}

FacePlan random_face(const CastingOptions& casting, std::uint64_t index, std::uint32_t attempt,
                     const FaceDistribution& distribution) {
  ManualRecipe open;
  open.id = face_id(casting.name, index);
  FacePlan face = random_face_plan(casting, open, {index, attempt}, distribution);
  face.index = index;
  return face;
}

FacePlan completed_face_plan(const CastingOptions& casting, const ManualRecipe& manual,
                             std::uint32_t attempt) {
  return random_face_plan(casting, manual, {0, attempt, concat("recipe/", manual.id)},
                          distribution_of_group(casting));
}

}  // namespace crowdface
