// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/edits.h"

#include <algorithm>

#include "crowdface/config/codec.h"

namespace crowdface {
namespace {

/// Returns the id of a recipe; empty if the recipe has no id.
std::string id_of(const YamlNode& recipe) {
  const YamlEntry* id = recipe.find("id");
  return id != nullptr ? id->value.text : std::string();
}

void merge_recipes(const YamlNode& recipes, YamlNode& config_recipes) {
  if (config_recipes.kind == YamlNode::Kind::kNothing) config_recipes.kind = YamlNode::Kind::kList;
  for (const YamlNode& recipe : recipes.items) {
    const auto there = std::ranges::find(config_recipes.items, id_of(recipe), id_of);
    if (there != config_recipes.items.end()) {
      *there = recipe;
    } else {
      config_recipes.items.push_back(recipe);
    }
  }
}

}  // namespace

void merge_faces_section(const YamlNode& faces, YamlNode& config_faces) {
  const YamlEntry* also = faces.find("also");
  if (also == nullptr) return;
  const auto there = std::ranges::find(config_faces.entries, "also", &YamlEntry::key);
  if (there == config_faces.entries.end()) return config_faces.entries.push_back(*also);
  std::vector<YamlNode>& items = there->value.items;
  items.insert(items.end(), also->value.items.begin(), also->value.items.end());
}

void merge_edits(const YamlNode& edits, YamlNode& root) {
  for (const YamlEntry& edit : edits.entries) {
    const auto own = std::ranges::find(root.entries, edit.key, &YamlEntry::key);
    if (own == root.entries.end()) {
      root.entries.push_back(edit);
    } else if (edit.key == "recipes") {
      merge_recipes(edit.value, own->value);
    } else if (edit.key == "faces") {
      merge_faces_section(edit.value, own->value);
    } else {
      own->value = edit.value;
    }
  }
}

void read_edits(YamlNode& root, ConfigDraft& draft) {
  const YamlEntry* named = root.find("edits");
  if (named == nullptr) return;
  const auto file = path("a file that crowdface edit writes").read(named->value, draft);
  if (!file || !expect_file(named->value, *file, draft)) return;
  draft.config.edits = *file;
  const auto edits = read_yaml(file->string(), draft.complaints);
  if (!edits) return;
  const MapReader known(*edits, {"faces", "regions", "recipes"}, draft.complaints);
  merge_edits(*edits, root);
}

}  // namespace crowdface
