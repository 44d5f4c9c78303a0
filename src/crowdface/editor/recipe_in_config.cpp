// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/recipe_in_config.h"

#include <algorithm>
#include <vector>

#include "crowdface/config/hand_recipe.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/config_text.h"
#include "crowdface/editor/flow_list.h"

namespace crowdface {
namespace {

using Lines = std::vector<std::string>;

/// "- " before the first line, blanks before the others.
Lines item_lines(const HandRecipe& recipe, const Config& config, std::size_t indent) {
  std::string text = format_hand_recipe(recipe, config);
  text.erase(0, std::min(text.find_first_not_of('\n'), text.size()));
  const std::string margin(indent, ' ');
  Lines lines;
  for (const std::string_view line : split_lines(text)) {
    lines.push_back(concat(margin, lines.empty() ? "- " : "  ", line));
  }
  return lines;
}

/// A value in one line.
std::string in_flow(const YamlNode& node) {
  std::vector<std::string> parts;
  if (node.kind == YamlNode::Kind::kList) {
    for (const YamlNode& item : node.items) parts.push_back(in_flow(item));
    return concat('[', join(parts), ']');
  }
  if (node.kind == YamlNode::Kind::kMap) {
    for (const YamlEntry& entry : node.entries) {
      parts.push_back(concat(write_scalar(entry.key), ": ", in_flow(entry.value)));
    }
    return concat('{', join(parts), '}');
  }
  return node.quoted ? write_scalar(node.text) : node.text;
}

/// The same in braces, a line for each key.
Lines braced_lines(const HandRecipe& recipe, const Config& config) {
  Complaints none;
  const auto node = parse_yaml(format_hand_recipe(recipe, config), "recipe", none);
  require(node && none.empty(), "a recipe that does not read back");
  Lines lines;
  for (const YamlEntry& entry : node->entries) {
    lines.push_back(concat(lines.empty() ? '{' : ' ', entry.key, ": ", in_flow(entry.value), ','));
  }
  lines.back().back() = '}';
  return lines;
}

const YamlNode* find_recipe(const std::vector<YamlNode>& items, const std::string& id) {
  for (const YamlNode& item : items) {
    const YamlEntry* there = item.find("id");
    if (there != nullptr && there->value.text == id) return &item;
  }
  return nullptr;
}

/// The line of a key that holds nothing: no value, `~`, `null` or `[]`, which goes.
std::string without_value(const std::string& line, const YamlPlace& key) {
  const std::size_t colon = line.find(':', static_cast<std::size_t>(key.column) - 1);
  const std::size_t value = line.find_first_not_of(" \t\r", colon + 1);
  if (value == line.npos || line[value] == '#') return line;
  const std::size_t end = line[value] == '['
                              ? line.find(']', value) + 1
                              : std::min(line.find_first_of(" \t\r", value), line.size());
  const std::size_t rest = line.find_first_not_of(" \t\r", end);
  return concat(line.substr(0, colon + 1), rest == line.npos ? "" : "  ",
                rest == line.npos ? "" : line.substr(rest));
}

}  // namespace

std::string with_recipe(std::string_view text, const std::string& source, const HandRecipe& recipe,
                        const Config& config) {
  const ConfigText old(text, source);
  const YamlEntry* section = old.root().find("recipes");
  constexpr std::size_t kIndent = 2;
  Lines added = item_lines(recipe, config, kIndent);
  if (section == nullptr) {
    added.insert(added.begin(), {"", "recipes:"});
    return old.with(old.line_count(), old.line_count(), added);
  }
  const std::vector<YamlNode>& items = section->value.items;
  if (const auto bracket = old.bracket_of(section->value)) {
    const FlowList list = find_flow_list(text, *bracket);
    require(list.items.size() == items.size(), "items of a list in brackets");
    const bool fits_a_line = text.substr(list.begin, list.end - list.begin).find('\n') == text.npos;
    if (!items.empty() || !fits_a_line || section->key_place.column > 1) {
      const Lines braced = braced_lines(recipe, config);
      const YamlNode* there = find_recipe(items, recipe.id);
      if (there == nullptr) return with_item(text, list, braced);
      return with_item_in_place(text, list.items[static_cast<std::size_t>(there - items.data())],
                                braced);
    }
  }
  const std::size_t key_line = line_of(section->key_place);
  if (items.empty()) {
    added.insert(added.begin(), without_value(old.line(key_line), section->key_place));
    return old.with(key_line, key_line + 1, added);
  }
  const std::size_t indent = old.line(line_of(items.front().place)).find_first_not_of(' ');
  added = item_lines(recipe, config, indent);
  if (const YamlNode* there = find_recipe(items, recipe.id)) {
    const std::size_t line = line_of(there->place);
    return old.with(line, old.end_of_block(line, indent), added);
  }
  const std::size_t end = old.end_of_block(line_of(items.back().place), indent);
  return old.with(end, end, added);
}

void put_recipe(const HandRecipe& recipe, const Config& config) {
  const std::filesystem::path& file = config.file;
  replace_config(file, with_recipe(read_file(file), file.string(), recipe, config));
}

}  // namespace crowdface
