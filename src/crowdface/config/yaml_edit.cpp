// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <set>

#include "crowdface/config/yaml.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::size_t kMaxKeys = 8;

/// Returns whether every YAML reader reads this text back unchanged if it is written without
/// quotes.
bool is_plain(std::string_view text) {
  static const std::set<std::string_view> words = {
      "null", "Null", "NULL", "true", "True", "TRUE", "false", "False", "FALSE",
      "yes",  "Yes",  "YES",  "no",   "No",   "NO",   "on",    "On",    "ON",
      "off",  "Off",  "OFF",  "y",    "Y",    "n",    "N"};
  if (text.empty() || words.contains(text)) return false;
  if (text == "." || text == "..") return true;
  const bool starts_well = text.starts_with("./") || text.starts_with("../") || text[0] == '/' ||
                           (text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z');
  return starts_well && text.find_first_not_of(
                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                            "_-./") == std::string_view::npos;
}

/// Sets the location of a command-line value and of all nodes inside it to the location of the
/// option.
void set_locations(YamlNode& node, const YamlPlace& place, const std::string& path) {
  node.place = place;
  node.path = path;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    set_locations(node.items[i], place, concat(path, " #", i + 1));
  }
  for (YamlEntry& entry : node.entries) {
    entry.key_place = place;
    set_locations(entry.value, place, concat(path, '.', entry.key));
  }
}

/// Returns the value of a key in a mapping. If the key is missing, adds the key without a value.
YamlNode& child(YamlNode& map, std::string_view key, const YamlPlace& place) {
  for (YamlEntry& entry : map.entries) {
    if (entry.key == key) return entry.value;
  }
  YamlNode node;
  node.place = place;
  node.path = map.path.empty() ? std::string(key) : concat(map.path, '.', key);
  map.entries.push_back({std::string(key), place, std::move(node)});
  return map.entries.back().value;
}

/// Sets the value at a path of keys. Creates mappings on the path where they are missing.
void put(YamlNode& root, const std::vector<std::string_view>& keys, YamlNode value,
         const YamlPlace& place, Complaints& out) {
  if (root.kind != YamlNode::Kind::kMap) return;  // the complaint is added when the root is read
  YamlNode* target = &root;
  for (const std::string_view key : keys) {
    if (target->kind == YamlNode::Kind::kNothing) target->kind = YamlNode::Kind::kMap;
    if (target->kind != YamlNode::Kind::kMap) {
      out.add(place, concat(target->path, " holds ", describe(*target), ", so ", quoted(key),
                            " cannot be set in it"));
      return;
    }
    target = &child(*target, key, place);
  }
  const std::string path = target->path;
  *target = std::move(value);
  set_locations(*target, place, path);
}

YamlPlace place_on_command_line(std::string shown) {
  return {std::make_shared<const std::string>(std::move(shown)), 0, 0};
}

}  // namespace

std::optional<YamlNode> read_yaml(const std::string& file, Complaints& out) {
  const YamlPlace whole_file = {std::make_shared<const std::string>(file), 0, 0};
  const auto refuse = [&](const char* what) {
    out.add(whole_file, what, ExitCode::kMissingInput);
    return std::nullopt;
  };
  if (is_folder(file)) {
    return refuse("expected a config file, found a folder");
  }
  // Read at most four bytes more than the limit, so that YamlText::find_problem sees that a longer
  // file is too long.
  std::string text(input_limits().yaml_bytes + 4, '\0');
  try {
    const OpenedFile opened = open_for_reading(file);
    text.resize(read_up_to(opened.descriptor, text.data(), text.size(), file));
  } catch (const MissingInput&) {
    return refuse(path_exists(file)
                      ? "expected a regular file that can be read"
                      : "the file does not exist or cannot be opened; check its path");
  }
  return parse_yaml(text, file, out);
}

std::string write_scalar(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += concat('\\', c);
    } else if (byte < 0x20 || byte == 0x7f) {
      out += concat("\\x", hex(byte, 2));
    } else {
      out += c;
    }
  }
  return out + '"';
}

void set_value(YamlNode& root, std::string_view assignment, Complaints& out) {
  constexpr std::size_t kLongest = 80;
  const YamlPlace place = place_on_command_line(
      concat("--set ", assignment.substr(0, kLongest), assignment.size() > kLongest ? "…" : ""));
  const std::size_t equals = assignment.find('=');
  const std::vector<std::string_view> keys = split(assignment.substr(0, equals), '.');
  if (equals == std::string_view::npos || keys.size() > kMaxKeys || contains(keys, "")) {
    return out.add(place, "expected key.path=value, such as crowd.count=20");
  }
  // An empty value becomes a null node, as in a file. The code that reads the key then adds a
  // complaint.
  const std::string_view value = assignment.substr(equals + 1);
  const bool empty = value.find_first_not_of(' ') == std::string_view::npos;
  Complaints of_value;
  auto node = parse_yaml(empty ? "~" : value, *place.source, of_value);
  for (const auto& complaint : of_value.all()) {
    out.add(place,
            concat("in its value, column ", complaint.place.column, ": ", complaint.message));
  }
  if (node) put(root, keys, std::move(*node), place, out);
}

void set_text(YamlNode& root, std::string_view key_path, std::string_view text,
              const std::string& shown_text, Complaints& out) {
  YamlNode node;
  node.kind = YamlNode::Kind::kScalar;
  node.text = text;
  put(root, split(key_path, '.'), std::move(node), place_on_command_line(shown_text), out);
}

}  // namespace crowdface
