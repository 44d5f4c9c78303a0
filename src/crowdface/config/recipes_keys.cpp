// SPDX-License-Identifier: Apache-2.0
// The config section `recipes`, which contains faces specified by hand.
#include <algorithm>
#include <map>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/config/traits_keys.h"

namespace crowdface {
namespace {

using HandBand = ManualRecipe::Band;
using HandRegion = ManualRecipe::Region;
using Unit = SmoothnessDistribution::Unit;

void read_band_weights(const YamlNode& node, HandBand& band, ConfigDraft& draft) {
  if (draft.config.blending.normalization == Normalization::kPrinted) {
    draft.complaints.add_at(
        node, "with blending.normalization: printed, expected position instead of weights");
  }
  read_head_weights(node, band.weights, draft);
}

bool in_iterations(const HandBand& band, const WriteContext&) {
  return band.smoothness && band.smoothness->unit == Unit::kIterations;
}

const Keys<HandBand>& recipe_band_keys() {
  static const Keys<HandBand> keys = {
      key("position", &HandBand::position, plane_point()),
      Key<HandBand>{"weights", read_band_weights,
                    [](const HandBand& band, const WriteContext& context) {
                      return band.weights.empty() ? "" : write_weights(band.weights, context);
                    }}
          .with_accepted_values("`{head: weight}`"),
      // The keys `smoothness` and `iterations` set the same member. The unit of the stored value
      // decides which of the two keys is written.
      key("smoothness", &HandBand::smoothness, smoothness()).written_if(std::not_fn(in_iterations)),
      key("iterations", &HandBand::smoothness, smoothness_in_iterations())
          .written_if(in_iterations),
      key("extrapolation", &HandBand::extrapolation, extrapolation())};
  return keys;
}

template <class Part>
void read_part(const YamlNode& node, const Keys<Part>& keys, Part& part, ConfigDraft& draft) {
  read_keys(node, keys, part, draft);
  for (const auto& [one, other] :
       {std::pair("position", "weights"), {"smoothness", "iterations"}}) {
    if (node.find(one) == nullptr || node.find(other) == nullptr) continue;
    draft.complaints.add_at(node, concat("expected either ", one, " or ", other, ", found both"));
  }
}

void read_recipe_bands(const YamlNode& node, HandRegion& region, ConfigDraft& draft) {
  const std::vector<std::string> names = draft.config.plan_names().bands;
  if (names.empty()) {
    draft.complaints.add_at(node, "the config has no bands; define them under sampling.bands");
    return;
  }
  const MapReader map(node, names, draft.complaints);
  region.bands.resize(names.size());
  for (std::size_t b = 0; b < names.size(); ++b) {
    if (const YamlNode* own = map.find(names[b]))
      read_part(*own, recipe_band_keys(), region.bands[b], draft);
  }
}

std::string write_recipe_bands(const HandRegion& region, const WriteContext& context) {
  std::vector<std::string> entries;
  for (std::size_t b = 0; b < region.bands.size(); ++b) {
    const std::vector<std::string> values =
        write_keys(recipe_band_keys(), region.bands[b], context);
    if (values.empty()) continue;
    entries.push_back(
        yaml_entry(write_scalar(context.config.sampling->bands[b].name), yaml_flow_map(values)));
  }
  return entries.empty() ? "" : yaml_flow_map(entries);
}

const Keys<HandRegion>& region_keys() {
  static const Keys<HandRegion> keys = [] {
    Keys<HandRegion> own;
    for (const Key<HandBand>& key : recipe_band_keys())
      own.push_back({key.name, key.read, key.write, {}, {}, key.accepted_values});
    own.push_back(
        Key<HandRegion>{"bands", read_recipe_bands, write_recipe_bands}.with_accepted_values(
            "`{band: {…}}`, the same keys"));
    return own;
  }();
  return keys;
}

HandRegion read_region(const YamlNode& node, ConfigDraft& draft) {
  HandRegion region;
  read_part(node, region_keys(), region, draft);
  return region;
}

/// Reads the values of a recipe's regions. A region without an entry has the values of the entry
/// `all`. If there is no entry `all` either, the region's values are random.
void read_regions_of(const YamlNode& node, ManualRecipe& recipe, ConfigDraft& draft) {
  if (!draft.complaints.expect_map(node, "a mapping from regions, or all, to their values")) return;
  const std::vector<std::string>& names = draft.config.regions.names;
  std::vector<std::string> keys = names;
  keys.emplace_back("all");
  if (!draft.are_regions_known) {
    for (const YamlEntry& entry : node.entries) keys.push_back(entry.key);
  }
  const MapReader map(node, keys, draft.complaints);
  if (const YamlNode* all = map.find("all")) {
    recipe.regions.assign(recipe.regions.size(), read_region(*all, draft));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const YamlNode* own = map.find(names[i])) recipe.regions[i] = read_region(*own, draft);
  }
}

std::string write_regions_of(const ManualRecipe& recipe, const WriteContext& context) {
  const std::vector<std::string> names = context.config.region_names();
  std::vector<std::string> entries;
  for (std::size_t i = 0; i < recipe.regions.size(); ++i) {
    entries.push_back(
        yaml_entry(write_scalar(names[i]),
                   yaml_flow_map(write_keys(region_keys(), recipe.regions[i], context))));
  }
  return yaml_block_map(entries);
}

/// Returns whether an id has the form of the ids of this crowd's sampled faces: NAME_0001 and so
/// on.
bool looks_sampled(std::string_view id, std::string_view crowd) {
  constexpr std::size_t kDigits = 4;
  if (crowd.empty() || !id.starts_with(crowd)) return false;
  id.remove_prefix(crowd.size());
  return id.size() > kDigits && id.front() == '_' &&
         id.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

/// Checks a recipe's id.
///
/// \param places  where each earlier id occurs in the files.
void check_id(const YamlNode& node, const std::string& id, std::map<std::string, YamlPlace>& places,
              ConfigDraft& draft) {
  if (looks_sampled(id, draft.config.crowd.name)) {
    draft.complaints.add_at(
        node, concat("ids like ", quoted(id), " belong to the sampled faces; choose another"));
  }
  const auto [first, is_new] = places.emplace(id, node.place);
  if (!is_new) {
    draft.complaints.add_at(
        node, concat("the id ", quoted(id), " is used twice; first ", "at ", first->second.text()));
  }
}

const Keys<ManualRecipe>& recipe_keys() {
  static const Keys<ManualRecipe> keys = {
      key("id", &ManualRecipe::id, name(), "the name of the face"),
      key("target", &ManualRecipe::target, head()),
      key("age", &ManualRecipe::age, age()),
      key("asymmetry", &ManualRecipe::asymmetry, asymmetry()),
      key("mirrored", &ManualRecipe::mirrored, word<bool>()),
      key("traits", &ManualRecipe::traits, trait_limits()),
      colours_key(&ManualRecipe::colours),
      Key<ManualRecipe>{"regions", read_regions_of, write_regions_of}
          .with_accepted_values("`{region: {…}}`")
          .with_nested_keys(region_keys())};
  return keys;
}

std::optional<ManualRecipe> read_recipe(const YamlNode& node, ConfigDraft& draft) {
  ManualRecipe recipe;
  recipe.regions.resize(draft.config.region_names().size());
  if (!read_keys(node, recipe_keys(), recipe, draft)) return std::nullopt;
  return recipe;
}

void read_recipes(const YamlNode& node, Config& config, ConfigDraft& draft) {
  draft.complaints.expect_list(node, "a list of recipes, [{id: …, target: …, regions: …}]");
  std::map<std::string, YamlPlace> places;
  for (const YamlNode& item : node.items) {
    std::optional<ManualRecipe> recipe = read_recipe(item, draft);
    if (!recipe) continue;
    if (!recipe->id.empty()) check_id(item.find("id")->value, recipe->id, places, draft);
    config.recipes.push_back(std::move(*recipe));
  }
}

std::string write_recipes(const Config& config, const WriteContext& context) {
  return write_sections(recipe_keys(), config.recipes, context);
}

}  // namespace

void read_head_weights(const YamlNode& node, std::vector<WeightedHead>& weights,
                       ConfigDraft& draft) {
  if (node.entries.empty()) {
    draft.complaints.add_mismatch(node, "a mapping from heads to weights, {head: weight}");
    return;
  }
  double sum = 0;
  bool is_valid = true;
  for (const YamlEntry& entry : node.entries) {
    const auto head = find_head(entry.key, entry.key_place, node.path, draft);
    const auto weight = read_number(entry.value, 0, kMaxSourceWeight, draft.complaints);
    sum += weight.value_or(0);
    is_valid = is_valid && weight;
    if (head && weight) weights.push_back({*head, *weight});
  }
  if (is_valid && sum <= 0) {
    draft.complaints.add_at(node, "the weights sum to zero; at least one must be above 0");
  }
  std::ranges::sort(weights, {}, &WeightedHead::head);
}

void read_colours(const YamlNode& node, std::vector<WeightedHead>& weights, ConfigDraft& draft) {
  if (draft.config.textures.blend != TextureBlend::kAuto) {
    draft.complaints.add_at(node, "requires textures.blend: auto");
  }
  read_head_weights(node, weights, draft);
}

Key<Config> recipes_key() {
  return Key<Config>{"recipes", read_recipes, write_recipes}.with_nested_keys(recipe_keys());
}

std::optional<ManualRecipe> parse_manual_recipe(std::string_view text, const std::string& source,
                                                const Config& config, Problems& problems) {
  Complaints complaints;
  ConfigDraft draft(complaints);
  draft.config = config;
  draft.are_heads_known = true;
  std::optional<ManualRecipe> recipe;
  if (const auto node = parse_yaml(text, source, complaints)) recipe = read_recipe(*node, draft);
  complaints.report_to(problems);
  return complaints.empty() ? std::move(recipe) : std::nullopt;
}

std::string format_manual_recipe(const ManualRecipe& recipe, const Config& config) {
  return yaml_block_map(write_keys(recipe_keys(), recipe, {config, {}}));
}

}  // namespace crowdface
