// SPDX-License-Identifier: Apache-2.0
// The section `recipes`: faces spelled out by hand.
#include <algorithm>
#include <map>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Whether an id is one that a sampled face of this crowd could get: NAME_0001 and so on.
bool looks_sampled(std::string_view id, std::string_view crowd) {
  constexpr std::size_t kDigits = 4;
  if (crowd.empty() || !id.starts_with(crowd)) return false;
  id.remove_prefix(crowd.size());
  return id.size() > kDigits && id.front() == '_' &&
         id.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

/// The ids seen so far, and where.
using Ids = std::map<std::string, YamlPlace>;

void read_id(const YamlNode& node, Ids& ids, HandRecipe& recipe, ConfigDraft& draft) {
  const auto id = read_name(node, draft.complaints);
  if (!id) return;
  recipe.id = *id;
  if (looks_sampled(*id, draft.config.crowd.name)) {
    draft.complaints.about(
        node, concat("ids like ", quoted(*id), " belong to the sampled faces; choose another"));
  }
  const auto [first, is_new] = ids.emplace(*id, node.place);
  if (!is_new) {
    draft.complaints.about(
        node, concat("the id ", quoted(*id), " stands here a second time; first ", "at ",
                     first->second.text()));
  }
}

std::vector<WeightedHead> read_weights(const YamlNode& node, ConfigDraft& draft) {
  std::vector<WeightedHead> weights;
  if (node.kind != YamlNode::Kind::kMap || node.entries.empty()) {
    draft.complaints.expected(node, "a mapping from heads to weights, {head: weight}");
    return weights;
  }
  if (draft.config.blending.normalization == Normalization::kPrinted) {
    draft.complaints.about(node, "blending.normalization: printed takes positions, no weights");
  }
  double sum = 0;
  bool sound = true;
  for (const YamlEntry& entry : node.entries) {
    const auto head = find_head(entry.key, entry.key_place, node.path, draft);
    const auto weight = read_number(entry.value, 0, kLargestWeight, draft.complaints);
    sum += weight.value_or(0);
    sound = sound && weight;
    if (head && weight) weights.push_back({*head, *weight});
  }
  if (sound && sum <= 0) {
    draft.complaints.about(node, "the weights sum to zero; at least one must be above 0");
  }
  std::sort(weights.begin(), weights.end(),
            [](const WeightedHead& a, const WeightedHead& b) { return a.head < b.head; });
  return weights;
}

HandRecipe::Region read_recipe_region(const YamlNode& node, ConfigDraft& draft) {
  HandRecipe::Region region;
  const MapReader map(&node, {"position", "weights", "smoothness", "iterations", "extrapolation"},
                      draft.complaints);
  const auto refuse_both = [&](const char* one, const char* other) {
    if (map.has(one) && map.has(other)) {
      draft.complaints.about(node, concat("either ", one, " or ", other, ", not both"));
    }
  };
  refuse_both("position", "weights");
  refuse_both("smoothness", "iterations");
  if (const YamlNode* position = map.find("position")) {
    region.position = read_point(*position, draft.complaints);
  }
  if (const YamlNode* weights = map.find("weights")) {
    region.weights = read_weights(*weights, draft);
  }
  if (const YamlNode* smoothness = map.find("smoothness")) {
    region.smoothness = read_smoothness(*smoothness, draft);
  }
  if (const YamlNode* iterations = map.find("iterations")) {
    region.smoothness = read_iterations(*iterations, draft);
  }
  if (const YamlNode* extrapolation = map.find("extrapolation")) {
    region.extrapolation = read_extrapolation(*extrapolation, draft);
  }
  return region;
}

/// Every region takes its own entry, or that of `all`, or is left to sampling.
void read_recipe_regions(const YamlNode* node, HandRecipe& recipe, ConfigDraft& draft) {
  const std::vector<std::string>& names = draft.config.regions.names;
  recipe.regions.assign(draft.config.region_names().size(), {});
  if (node == nullptr) return;
  if (!draft.complaints.expect_map(*node, "a mapping from regions, or all, to their values"))
    return;
  std::vector<std::string> keys = names;
  keys.emplace_back("all");
  if (!draft.regions_known) {
    for (const YamlEntry& entry : node->entries) keys.push_back(entry.key);
  }
  const MapReader map(node, keys, draft.complaints);
  if (const YamlNode* all = map.find("all")) {
    recipe.regions.assign(recipe.regions.size(), read_recipe_region(*all, draft));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const YamlNode* own = map.find(names[i])) {
      recipe.regions[i] = read_recipe_region(*own, draft);
    }
  }
}

}  // namespace

void read_recipes(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (!draft.complaints.expect_list(*node, "a list of recipes, [{id: …, target: …, regions: …}]"))
    return;
  Ids ids;
  for (const YamlNode& item : node->items) {
    const MapReader map(&item, {"id", "target", "age", "regions"}, draft.complaints);
    HandRecipe recipe;
    if (const YamlNode* id = map.require("id", "the name of the face")) {
      read_id(*id, ids, recipe, draft);
    }
    if (const YamlNode* target = map.find("target")) {
      const auto name = read_name(*target, draft.complaints);
      if (name) recipe.target = find_head(*name, target->place, target->path, draft);
    }
    if (const YamlNode* age = map.find("age")) recipe.age = read_age(*age, draft);
    read_recipe_regions(map.find("regions"), recipe, draft);
    draft.config.recipes.push_back(std::move(recipe));
  }
}

}  // namespace crowdface
