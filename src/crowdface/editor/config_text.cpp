// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/config_text.h"

#include <algorithm>
#include <optional>

#include "crowdface/config/config_reader.h"
#include "crowdface/config/config_values.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/flow_list.h"

namespace crowdface {
namespace {

using Lines = std::vector<std::string>;

YamlNode parsed(std::string_view text, const std::string& source) {
  Complaints complaints;
  auto root = parse_yaml(text, source, complaints);
  Problems problems;
  complaints.tell(problems);
  problems.throw_if_any();
  return std::move(*root);
}

/// Whether nothing but a comment stands there.
bool is_empty(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

/// The line of a place, counted from 0.
std::size_t line_of(const YamlPlace& place) {
  return static_cast<std::size_t>(place.line) - 1;
}

/// The lines of a config of which some are replaced.
class ConfigText {
 public:
  /// \param source  the file's name, for messages
  /// \throws Error with everything about the text that is not YAML.
  ConfigText(std::string_view text, const std::string& source) : root_(parsed(text, source)) {
    for (const std::string_view line : split_lines(text)) lines_.emplace_back(line);
  }

  const YamlNode& root() const { return root_; }
  std::size_t line_count() const { return lines_.size(); }
  /// Without its end.
  const std::string& line(std::size_t i) const { return lines_[i]; }

  /// Where in the text the bracket of a list stands, in bytes; nothing if it has none.
  std::optional<std::size_t> bracket_of(const YamlNode& list) const {
    if (list.kind != YamlNode::Kind::kList) return std::nullopt;
    const std::size_t row = line_of(list.place);
    const std::string& line = lines_[row];
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    std::size_t at = row == 0 && line.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    for (int column = 1; column < list.place.column && at < line.size(); ++column) {
      do {
        ++at;
      } while (at < line.size() && is_utf8_continuation(line[at]));
    }
    if (at >= line.size() || line[at] != '[') return std::nullopt;
    for (std::size_t i = 0; i < row; ++i) at += lines_[i].size() + 1;
    return at;
  }

  /// One past the last line that belongs to what begins on line `begin`: what follows is indented by
  /// `indent` or less, or nothing. Comments after it belong to what comes next.
  std::size_t end_of_block(std::size_t begin, std::size_t indent) const {
    std::size_t end = begin + 1;
    for (std::size_t i = end; i < lines_.size(); ++i) {
      if (is_empty(lines_[i])) continue;
      if (lines_[i].find_first_not_of(' ') <= indent) break;
      end = i + 1;
    }
    return end;
  }

  /// The whole text with other lines in place of `from` up to `to`.
  std::string with(std::size_t from, std::size_t to, const Lines& others) const {
    std::string text;
    for (std::size_t i = 0; i < from; ++i) text += lines_[i] + '\n';
    for (const std::string& line : others) text += line + '\n';
    for (std::size_t i = to; i < lines_.size(); ++i) text += lines_[i] + '\n';
    return text;
  }

 private:
  Lines lines_;
  YamlNode root_;
};

/// Replaces a config's file if the text reads back well.
/// \throws Error with every problem that the config would have.
void replace_config(const std::filesystem::path& file, const std::string& text) {
  // Paths in a config start at its folder, so that it is tried there.
  const std::filesystem::path trial =
      file.parent_path() / concat(".", file.filename().string(), ".edited");
  write_file(trial, text);
  Problems problems;
  read_config(trial, {}, problems);
  remove_if_there(trial);
  problems.throw_if_any();
  write_file(file, text);
}

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
  if (node.kind == YamlNode::Kind::kList) return flow_list(texts_of(node.items, in_flow));
  if (node.kind == YamlNode::Kind::kMap) {
    return flow_map(texts_of(node.entries, [](const YamlEntry& child) {
      return entry(write_scalar(child.key), in_flow(child.value));
    }));
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

/// Whether the keys of a section stand on lines of their own.
bool has_lines(const ConfigText& text, const YamlEntry& section) {
  if (section.value.entries.empty()) return false;
  const YamlPlace& first = section.value.entries.front().key_place;
  if (line_of(first) == line_of(section.key_place)) return false;
  const std::string& line = text.line(line_of(first));
  return line[line.find_first_not_of(' ')] != '{';
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

std::string with_regions(std::string_view text, const std::string& source,
                         const std::vector<std::string>& names,
                         const std::vector<std::string>& masks) {
  const std::string names_entry = entry("names", flow_names(names));
  const std::string mask_entry =
      entry("mask", masks.size() == 1 ? write_scalar(masks.front()) : flow_names(masks));
  const ConfigText old(text, source);
  const YamlEntry* section = old.root().find("regions");
  Lines whole = {"regions:", concat("  ", names_entry), concat("  ", mask_entry)};
  if (section == nullptr) {
    whole.insert(whole.begin(), "");
    return old.with(old.line_count(), old.line_count(), whole);
  }
  const std::size_t begin = line_of(section->key_place);
  if (!has_lines(old, *section)) return old.with(begin, old.end_of_block(begin, 0), whole);
  const std::string& first = old.line(line_of(section->value.entries.front().key_place));
  const std::size_t indent = first.find_first_not_of(' ');
  std::string changed(text);
  for (const auto& [key, entry] :
       {std::pair("mask", mask_entry), std::pair("names", names_entry)}) {
    const ConfigText now(changed, source);
    const YamlEntry* there = now.root().find("regions")->value.find(key);
    const std::string line = concat(std::string(indent, ' '), entry);
    if (there == nullptr) {
      changed = now.with(begin + 1, begin + 1, {line});
      continue;
    }
    const std::vector<YamlNode>& items = there->value.items;  // dashes may stand below their key
    const YamlPlace& last = items.empty() ? there->key_place : items.back().place;
    changed = now.with(line_of(there->key_place), now.end_of_block(line_of(last), indent), {line});
  }
  return changed;
}

void put_regions(const std::filesystem::path& config, const std::vector<std::string>& names,
                 const std::vector<std::filesystem::path>& masks) {
  std::vector<std::string> from_config;
  for (const std::filesystem::path& mask : masks) {
    const auto path = std::filesystem::absolute(mask).lexically_normal();
    const auto folder = std::filesystem::absolute(config).lexically_normal().parent_path();
    from_config.push_back(path.lexically_proximate(folder).generic_string());
  }
  replace_config(config, with_regions(read_file(config), config.string(), names, from_config));
}

}  // namespace crowdface
