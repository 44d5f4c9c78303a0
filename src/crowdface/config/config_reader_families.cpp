// SPDX-License-Identifier: Apache-2.0
// The section `families`.
#include <algorithm>

#include "crowdface/cast/families.h"
#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr double kMaxDistance = 1000;  // mm
constexpr std::uint64_t kMostMembers = 1000;

/// Whether a family before this one has a member of that id, with or without the crowd's name.
bool is_member(const std::string& id, const ConfigDraft& draft) {
  const std::string& crowd = draft.config.crowd.name;
  for (const FamilyOptions& family : draft.config.families) {
    for (int m = 1; m <= family.members; ++m) {
      const std::string full = member_id(crowd, family.name, m);
      if (id == full || full == concat(crowd, '_', id)) return true;
    }
  }
  return false;
}

std::optional<Parent> read_parent(const YamlNode& node, ConfigDraft& draft) {
  const auto name = read_name(node, draft.complaints);
  if (!name) return std::nullopt;
  const auto& heads = draft.config.faces.names;
  const auto head = std::find(heads.begin(), heads.end(), *name);
  if (head != heads.end()) return Parent{head - heads.begin(), *name};
  const auto& recipes = draft.config.recipes;
  const bool known = std::any_of(recipes.begin(), recipes.end(),
                                 [&](const HandRecipe& recipe) { return recipe.id == *name; }) ||
                     is_member(*name, draft);
  if (!known && draft.heads_known) {
    draft.complaints.about(node, concat("expected a head, a recipe's id or a member of a family ",
                                        "before this one (smith_01), found ", quoted(*name)));
  }
  return Parent{std::nullopt, *name};
}

void read_parents(const YamlNode& node, FamilyOptions& family, ConfigDraft& draft) {
  const MapReader map(&node, {"mother", "father"}, draft.complaints);
  const YamlNode* mother = map.require("mother", "a head, a recipe or a member of another family");
  const YamlNode* father = map.require("father", "a head, a recipe or a member of another family");
  if (mother == nullptr || father == nullptr) return;
  const auto first = read_parent(*mother, draft);
  const auto second = read_parent(*father, draft);
  if (first && second) family.parents = {*first, *second};
}

void read_inherit(const YamlNode* node, FamilyOptions& family, ConfigDraft& draft) {
  const std::vector<std::string> names = draft.config.region_names();
  family.inherit.assign(names.size(), -1);
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kMap && family.parents.empty()) {
    draft.complaints.about(*node, "only a family with parents inherits");
  }
  if (!draft.regions_known && node->kind == YamlNode::Kind::kMap) return;
  const MapReader map(node, names, draft.complaints);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const YamlNode* from = map.find(names[k]);
    if (from == nullptr) continue;
    family.inherit[k] = read_choice(*from, words_of<int>(), draft.complaints).value_or(-1);
  }
}

void read_name_of(const YamlNode& node, FamilyOptions& family, ConfigDraft& draft) {
  const auto name = read_name(node, draft.complaints);
  if (!name) return;
  family.name = *name;
  const auto& families = draft.config.families;
  if (std::any_of(families.begin(), families.end(),
                  [&](const FamilyOptions& other) { return other.name == *name; })) {
    draft.complaints.about(node, concat("two families are called ", quoted(*name)));
  }
  if (name->find_first_not_of("0123456789") == std::string::npos) {
    draft.complaints.about(node,
                           "a family's name needs a letter, or its members would be called "
                           "like sampled faces");
  }
}

void refuse_taken_ids(const YamlNode& node, const FamilyOptions& family, ConfigDraft& draft) {
  for (int m = 1; m <= family.members; ++m) {
    const std::string id = member_id(draft.config.crowd.name, family.name, m);
    for (const HandRecipe& recipe : draft.config.recipes) {
      if (recipe.id == id) {
        draft.complaints.about(node, concat("the recipe ", quoted(id), " is called like a member"));
      }
    }
  }
}

std::optional<double> read_distance_of(const YamlNode* node, ConfigDraft& draft) {
  return node == nullptr ? std::nullopt : read_length_mm(*node, kMaxDistance, draft.complaints);
}

void read_family(const YamlNode& node, ConfigDraft& draft) {
  const MapReader map(
      &node,
      {"name", "members", "target", "parents", "inherit", "max_distance", "min_distance", "age"},
      draft.complaints);
  if (node.kind != YamlNode::Kind::kMap) return;
  FamilyOptions family;
  if (const YamlNode* name = map.require("name", "such as smith")) {
    read_name_of(*name, family, draft);
  }
  if (const YamlNode* members = map.require("members", "how many faces")) {
    family.members =
        static_cast<int>(read_whole(*members, 1, kMostMembers, draft.complaints).value_or(1));
  }
  if (const YamlNode* target = map.find("target")) {
    const auto name = read_name(*target, draft.complaints);
    if (name) family.target = find_head(*name, target->place, target->path, draft);
  }
  if (const YamlNode* parents = map.find("parents")) read_parents(*parents, family, draft);
  read_inherit(map.find("inherit"), family, draft);
  const YamlNode* max =
      map.require("max_distance", "how far members may be from their founder, such as \"2.5 mm\"");
  family.max_distance_mm = read_distance_of(max, draft).value_or(1);
  if (max != nullptr && family.max_distance_mm == 0) {
    draft.complaints.expected(*max, "a length above 0 mm");
  }
  const YamlNode* min = map.find("min_distance");
  family.min_distance_mm = read_distance_of(min, draft).value_or(0);
  if (min != nullptr && family.min_distance_mm > 2 * family.max_distance_mm) {
    draft.complaints.about(*min,
                           "members that are all within max_distance of one founder cannot be "
                           "more than twice that apart");
  }
  if (const YamlNode* age = map.find("age")) {
    family.age = read_age(*age, draft).value_or(Range{0, 0});
  }
  refuse_taken_ids(node, family, draft);
  draft.config.families.push_back(std::move(family));
}

}  // namespace

void read_families(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (!draft.complaints.expect_list(*node, "a list of families, [{name: smith, members: 6, …}]"))
    return;
  for (const YamlNode& item : node->items) read_family(item, draft);
}

}  // namespace crowdface
