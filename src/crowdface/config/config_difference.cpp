// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_difference.h"

#include <algorithm>
#include <set>

#include "crowdface/cast/diversity.h"
#include "crowdface/config/config.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/words.h"
#include "crowdface/config/yaml.h"

namespace crowdface {
namespace {

constexpr const char* kCount = "crowd.count";
constexpr const char* kDistance = "diversity.min_distance";
constexpr const char* kFirstDistances = "diversity.min_distance_of_first";

/// Removes the numbers of list items from a node's path: "attachments.items #2.file" becomes
/// "attachments.items.file".
std::string path_of_key(std::string path) {
  for (std::size_t at = path.find(" #"); at != path.npos; at = path.find(" #", at)) {
    path.erase(at, std::min(path.find('.', at), path.size()) - at);
  }
  return path;
}

void remove_keys(const std::set<std::string>& paths, YamlNode& node) {
  std::erase_if(node.entries, [&](const YamlEntry& entry) {
    return paths.contains(path_of_key(entry.value.path));
  });
  for (YamlEntry& entry : node.entries) remove_keys(paths, entry.value);
  for (YamlNode& item : node.items) remove_keys(paths, item);
}

/// Adds to `paths` the paths of all values that differ between `a` and `b`, or that are missing in
/// one of the two.
///
/// \param defaults  values for keys that are missing in `a` because an older version wrote `a`; may
///                  be null.
void add_differences(const YamlNode& a, const YamlNode& b, const YamlNode* defaults,
                     std::vector<std::string>& paths) {
  const auto add = [&](const YamlNode& node) {
    paths.push_back(node.path.empty() ? "its keys" : node.path);
  };
  if (a.kind != b.kind || a.text != b.text || a.items.size() != b.items.size()) return add(b);
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    std::vector<std::string> inside;
    add_differences(a.items[i], b.items[i], nullptr, inside);
    if (!inside.empty()) return add(b);
  }
  for (const YamlEntry& entry : b.entries) {
    const YamlEntry* own_default = defaults == nullptr ? nullptr : defaults->find(entry.key);
    const YamlNode* value = own_default == nullptr ? nullptr : &own_default->value;
    const YamlEntry* old = a.find(entry.key);
    const YamlNode* before = old == nullptr ? value : &old->value;
    if (before == nullptr) {
      if (entry.value.kind != YamlNode::Kind::kMap || !entry.value.entries.empty())
        add(entry.value);
    } else {
      add_differences(*before, entry.value, value, paths);
    }
  }
  for (const YamlEntry& entry : a.entries) {
    if (b.find(entry.key) == nullptr) add(entry.value);
  }
}

bool is_same(const YamlNode& a, const YamlNode& b) {
  std::vector<std::string> paths;
  add_differences(a, b, nullptr, paths);
  return paths.empty();
}

/// Removes from each entry of `groups` the keys that have the same value in the section `sampling`:
/// the group inherits these keys. If such a key differs between two configs, the difference is then
/// reported only once, for `sampling`.
void remove_inherited_keys(YamlNode& root) {
  const YamlEntry* sampling = root.find("sampling");
  const auto groups = std::ranges::find(root.entries, "groups", &YamlEntry::key);
  if (sampling == nullptr || groups == root.entries.end()) return;
  for (YamlNode& group : groups->value.items) {
    std::erase_if(group.entries, [&](const YamlEntry& entry) {
      const YamlEntry* common = sampling->value.find(entry.key);
      return common != nullptr && is_same(common->value, entry.value);
    });
  }
}

const YamlNode* node_at(const YamlNode& root, std::string_view key_path) {
  const YamlNode* node = &root;
  while (node != nullptr && !key_path.empty()) {
    const std::size_t end = std::min(key_path.find('.'), key_path.size());
    const YamlEntry* entry = node->find(std::string(key_path.substr(0, end)));
    node = entry == nullptr ? nullptr : &entry->value;
    key_path.remove_prefix(std::min(end + 1, key_path.size()));
  }
  return node;
}

std::optional<std::uint64_t> number_at(const YamlNode& root, std::string_view key_path) {
  const YamlNode* node = node_at(root, key_path);
  return node == nullptr ? std::nullopt : parse_unsigned(node->text);
}

bool casts_one_by_one(const YamlNode& root) {
  const YamlNode* mode = node_at(root, "diversity.mode");
  return mode == nullptr || mode->text == word_of(DiversityOptions::Mode::kFirstFit);
}

/// Returns whether a crowd with the config `old` only grows if its config becomes `root`: the old
/// faces are then the first faces of the new crowd.
bool only_grows(const YamlNode& old, const YamlNode& root) {
  const auto before = number_at(old, kCount), now = number_at(root, kCount);
  return casts_one_by_one(root) && before && now && *before <= *now;
}

/// Reads a length in the form in which effective_config writes lengths, such as "1.2 mm".
std::optional<double> millimetres_of(const YamlNode& node) {
  constexpr std::string_view kUnit = " mm";
  return node.text.ends_with(kUnit)
             ? parse_double(node.text.substr(0, node.text.size() - kUnit.size()))
             : std::nullopt;
}

std::optional<RequiredDistances> distances_of(const YamlNode& root) {
  if (!casts_one_by_one(root)) return std::nullopt;
  RequiredDistances distances;
  if (const YamlNode* last = node_at(root, kDistance)) {
    const auto mm = millimetres_of(*last);
    if (!mm) return std::nullopt;
    distances.min_distance_mm = *mm;
  }
  const YamlNode* first = node_at(root, kFirstDistances);
  if (first == nullptr) return distances;
  for (const YamlEntry& entry : first->entries) {
    const auto faces = parse_unsigned(entry.key);
    const auto mm = millimetres_of(entry.value);
    if (!faces || !mm) return std::nullopt;
    distances.min_distance_mm_up_to_face[*faces] = *mm;
  }
  return distances;
}

/// Returns whether the config `root` requires the same minimum distances as the config `old`, for
/// all sampled faces and families of the crowd that was made with `old`.
bool keeps_distances(const YamlNode& old, const YamlNode& root) {
  const auto before = distances_of(old), now = distances_of(root);
  const auto count = number_at(old, kCount);
  if (!before || !now || !count) return false;
  DiversityOptions a, b;
  a.min_distance_mm = before->min_distance_mm;
  a.min_distance_mm_up_to_face = before->min_distance_mm_up_to_face;
  b.min_distance_mm = now->min_distance_mm;
  b.min_distance_mm_up_to_face = now->min_distance_mm_up_to_face;
  // The required distance is constant between these face numbers, so it is enough to compare the
  // distances at these numbers.
  std::set<std::uint64_t> ends = {0, *count};
  for (const auto* distances : {&*before, &*now}) {
    for (const auto& first : distances->min_distance_mm_up_to_face)
      ends.insert(std::min(first.first, *count));
  }
  return std::ranges::all_of(ends, [&](std::uint64_t face) {
    return a.min_distance_mm_of(face) == b.min_distance_mm_of(face);
  });
}

}  // namespace

std::vector<std::string> config_differences(const std::string& old_text, const std::string& text) {
  if (old_text == text) return {};
  Complaints complaints;
  auto old = parse_yaml(old_text, "", complaints);
  auto root = parse_yaml(text, "", complaints);
  if (!old || !root || !complaints.empty())
    return {"every key, because one of the two is not a valid config"};
  auto defaults = parse_yaml(effective_config(Config{}, "/"), "", complaints);
  std::set<std::string> ignored = keys_not_affecting_recipes();
  if (only_grows(*old, *root)) {
    ignored.insert(kCount);
    if (keeps_distances(*old, *root)) ignored.insert({kDistance, kFirstDistances});
  }
  for (YamlNode* node : {&*old, &*root, defaults ? &*defaults : nullptr}) {
    if (node == nullptr) continue;
    remove_keys(ignored, *node);
    remove_inherited_keys(*node);
  }
  std::vector<std::string> paths;
  add_differences(*old, *root, defaults ? &*defaults : nullptr, paths);
  return paths;
}

std::optional<RequiredDistances> distances_in_config(const std::string& text) {
  Complaints complaints;
  const auto root = parse_yaml(text, "", complaints);
  return root ? distances_of(*root) : std::nullopt;
}

std::optional<std::uint64_t> number_in_config(const std::string& text, std::string_view key_path) {
  Complaints complaints;
  const auto root = parse_yaml(text, "", complaints);
  return root ? number_at(*root, key_path) : std::nullopt;
}

}  // namespace crowdface
