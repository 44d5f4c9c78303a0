// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/recipe_json.h"

#include <algorithm>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/head_mirror.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Whether the band has a position on the plane and exactly the weights that this position
/// determines.
bool comes_from_position(const BandRecipe& band, const std::vector<Index>& sources, Index target,
                         const CastingOptions& casting) {
  return band.position &&
         weights_at_position(casting.anchors, target, sources, *band.position,
                             casting.normalization, casting.sampling.max_sources) == band.weights;
}

Json band_to_json(const BandRecipe& band, const std::vector<Index>& sources, Index target,
                  const CastingOptions& casting, const std::vector<std::string>& heads) {
  Json json;
  // Write the position if the weights are empty, because a config cannot express empty weights.
  // With `normalization: printed`, the weights may be empty.
  if (comes_from_position(band, sources, target, casting) || band.weights.empty()) {
    const PlanePoint at = band.position.value_or(PlanePoint::Zero());
    json["position"] = {at.x(), at.y()};
  } else {
    for (const SourceWeight& source : band.weights) {
      json["weights"][heads[static_cast<std::size_t>(source.head)]] = source.weight;
    }
  }
  if (iterations_of(band.smoothness, casting.level_scale) == band.iterations) {
    json["smoothness"] = band.smoothness;
  } else {
    json["iterations"] = band.iterations;
  }
  json["extrapolation"] = band.extrapolation;
  return json;
}

/// Stores the values of the first band directly in the region's object, and the values of each
/// further band under `bands` and the band's name.
Json region_to_json(const RegionRecipe& region, Index target, const CastingOptions& casting,
                    const std::vector<std::string>& heads) {
  const SamplingOptions& sampling = casting.sampling;
  Json json = band_to_json(region, sources_of(sampling, 0), target, casting, heads);
  for (std::size_t b = 1; b < band_count(region); ++b) {
    json["bands"][sampling.bands[b].name] =
        band_to_json(band_of(region, b), sources_of(sampling, b), target, casting, heads);
  }
  return json;
}

/// Reads a mixture of heads. \throws UsageError if the value is not a valid mixture.
std::vector<SourceWeight> read_mixture(const Json& json, const Config& config) {
  const std::vector<std::string>& names = config.faces.names;
  std::vector<SourceWeight> shares;
  double sum = 0;
  for (const auto& [name, share] : json.items()) {
    const auto head = std::ranges::find(names, name);
    if (head == names.end()) {
      throw UsageError(concat("mixture: no head is called ", quoted(name)));
    }
    const double value = share.is_number() ? share.get<double>() : -1;
    if (!(value >= 0 && value <= kMaxSourceWeight)) {
      throw UsageError(concat("mixture.", name, ": expected a number from 0"));
    }
    shares.push_back({static_cast<Index>(head - names.begin()), value});
    sum += value;
  }
  if (!(sum > 0)) throw UsageError("mixture: expected shares of heads, one above 0");
  // If the sum of the shares differs from one by at most this value, the shares are not normalised
  // and stay bitwise unchanged.
  constexpr double kRounding = 1e-12;
  if (std::abs(sum - 1) > kRounding) return normalized_weights(std::move(shares));
  std::erase_if(shares, [](const SourceWeight& share) { return share.weight == 0; });
  std::ranges::sort(shares, [](const auto& a, const auto& b) { return a.head < b.head; });
  return shares;
}

}  // namespace

Json recipe_to_json(const FacePlan& face, const CastingOptions& casting, const Config& config) {
  const std::vector<std::string>& heads = config.faces.names;
  Json json;
  json["id"] = face.id;
  json["target"] = heads[static_cast<std::size_t>(face.recipe.target)];
  for (const SourceWeight& part : face.recipe.mixture) {
    json["mixture"][heads[static_cast<std::size_t>(part.head)]] = part.weight;
  }
  for (const SourceWeight& part : face.recipe.colours) {
    json["colours"][heads[static_cast<std::size_t>(part.head)]] = part.weight;
  }
  if (!is_unmirrored(face.recipe) || may_mirror(casting.sampling)) {
    json["asymmetry"] = face.recipe.asymmetry;
    json["mirrored"] = face.recipe.mirrored;
  }
  json["regions"] = Json::object();
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    json["regions"][casting.region_names[k]] =
        region_to_json(face.recipe.regions[k], face.recipe.target, casting, heads);
  }
  return json;
}

ManualRecipe manual_recipe_of_json(const Json& recipe, const Config& config) {
  if (!recipe.is_object()) throw UsageError("recipe: expected a mapping");
  Problems problems;
  auto hand = parse_manual_recipe(recipe.dump(), "recipe", config, problems);
  problems.throw_if_any();
  return std::move(*hand);
}

FacePlan face_of_json(const Json& recipe, const CastingOptions& casting, const Config& config) {
  Json entry = recipe;
  std::vector<SourceWeight> mixture;
  if (entry.is_object() && entry.contains("mixture")) {
    mixture = read_mixture(entry["mixture"], config);
    entry.erase("mixture");
  }
  ManualRecipe hand = manual_recipe_of_json(entry, config);
  if (!hand.age) hand.age = AgeRange{};
  if (!hand.asymmetry) hand.asymmetry = Range{1, 1};
  if (!hand.mirrored) hand.mirrored = false;
  FacePlan face = completed_face_plan(casting, hand);
  if (!is_unmirrored(face.recipe) && mirroring_key(config).empty()) {
    throw UsageError(
        "asymmetry and mirrored: expected a config that has sampling.asymmetry, "
        "sampling.mirror or a recipe with either");
  }
  if (!mixture.empty()) set_target_heads(face.recipe, std::move(mixture));
  return face;
}

}  // namespace crowdface
