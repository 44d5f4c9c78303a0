// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/recipe_in_config.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "crowdface/config/complaints.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/config/hand_recipe.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(std::string_view text) {
  Lines lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string text_of(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Whether nothing but a comment stands there.
bool is_empty(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

/// One past the last line that belongs to what begins on line `begin`: what follows is indented as it is
/// or less, or nothing. Comments after it belong to what comes next.
std::size_t end_of_block(const Lines& lines, std::size_t begin, std::size_t indent) {
  std::size_t end = begin + 1;
  for (std::size_t i = end; i < lines.size(); ++i) {
    if (is_empty(lines[i])) continue;
    if (lines[i].find_first_not_of(' ') <= indent) break;
    end = i + 1;
  }
  return end;
}

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
  Complaints complaints;
  const auto root = parse_yaml(text, source, complaints);
  Problems problems;
  complaints.tell(problems);
  problems.throw_if_any();
  Lines lines = lines_of(text);
  const YamlEntry* section = root->find("recipes");
  const auto put = [&](std::size_t from, std::size_t to, const Lines& added) {
    const auto at = lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(from),
                                lines.begin() + static_cast<std::ptrdiff_t>(to));
    lines.insert(at, added.begin(), added.end());
    return text_of(lines);
  };
  constexpr std::size_t kIndent = 2;
  Lines added = item_lines(recipe, config, kIndent);
  if (section == nullptr) {
    added.insert(added.begin(), {"", "recipes:"});
    return put(lines.size(), lines.size(), added);
  }
  const auto key_line = static_cast<std::size_t>(section->key_place.line) - 1;
  const std::vector<YamlNode>& items = section->value.items;
  if (items.empty()) {
    added.insert(added.begin(), "recipes:");
    return put(key_line, key_line + 1, added);
  }
  const auto line_of = [](const YamlNode& node) {
    return static_cast<std::size_t>(node.place.line) - 1;
  };
  const std::string& first = lines[line_of(items.front())];
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
    return put(line_of(item), end_of_block(lines, line_of(item), indent), added);
  }
  const std::size_t end = end_of_block(lines, line_of(items.back()), indent);
  return put(end, end, added);
}

void put_recipe(const HandRecipe& recipe, const Config& config) {
  const std::filesystem::path& file = config.file;
  const std::string text = with_recipe(read_file(file), file.string(), recipe, config);
  // Paths in a config start at its folder, so that it is tried there.
  const std::filesystem::path trial =
      file.parent_path() / concat(".", file.filename().string(), ".edited");
  write_file(trial, text);
  Problems problems;
  read_config(trial, {}, problems);
  std::error_code ignored;
  std::filesystem::remove(trial, ignored);
  problems.throw_if_any();
  write_file(file, text);
}

}  // namespace crowdface
