// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/recipe_in_config.h"

#include <algorithm>
#include <vector>

#include "crowdface/config/hand_recipe.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/config_text.h"

namespace crowdface {
namespace {

using Lines = std::vector<std::string>;

/// "- " before the first line, blanks before the others.
Lines item_lines(const HandRecipe& recipe, const Config& config, std::size_t indent) {
  std::string text = format_hand_recipe(recipe, config);
  text.erase(0, std::min(text.find_first_not_of('\n'), text.size()));
  Lines lines = lines_of(text);
  const std::string margin(indent, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i] = concat(margin, i == 0 ? "- " : "  ", lines[i]);
  }
  return lines;
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
  const std::size_t key_line = line_of(section->key_place);
  const std::vector<YamlNode>& items = section->value.items;
  if (items.empty()) {
    added.insert(added.begin(), "recipes:");
    return old.with(key_line, key_line + 1, added);
  }
  const std::string& first = old.line(line_of(items.front().place));
  const std::size_t indent = first.find_first_not_of(' ');
  if (indent == std::string::npos || first[indent] != '-') {
    throw UsageError(concat(source,
                            ": the recipes stand in [brackets]; expected a list with a line ",
                            "and a dash for each, to which one can be added"));
  }
  added = item_lines(recipe, config, indent);
  for (const YamlNode& item : items) {
    const YamlEntry* id = item.find("id");
    if (id == nullptr || id->value.text != recipe.id) continue;
    const std::size_t line = line_of(item.place);
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
