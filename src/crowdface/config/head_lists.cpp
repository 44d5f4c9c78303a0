// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/head_lists.h"

#include <algorithm>
#include <map>
#include <set>

#include "crowdface/blend/recipe_bounds.h"

namespace crowdface {
namespace {

/// `{name: weight}`: a head's own entry counts alone, the weights of several tags add up.
std::vector<WeightedHead> read_weights(const YamlNode& node, ConfigDraft& draft) {
  std::map<Eigen::Index, double> by_tag, by_name;
  for (const YamlEntry& entry : node.entries) {
    const auto heads = find_heads(entry.key, entry.key_place, node.path, draft);
    const auto weight = read_number(entry.value, 0, kLargestWeight, draft.complaints);
    if (weight == 0.0) {
      draft.complaints.expected(entry.value, "a weight above 0 (leave the head out for none)");
    }
    for (const Eigen::Index head : heads) {
      const bool named = draft.config.faces.names[static_cast<std::size_t>(head)] == entry.key;
      (named ? by_name : by_tag)[head] += weight.value_or(1);
    }
  }
  by_name.merge(by_tag);  // keeps what is there
  std::vector<WeightedHead> targets;
  for (const auto& [head, weight] : by_name) targets.push_back({head, weight});
  return targets;
}

std::vector<Eigen::Index> read_heads(const YamlNode& node, ConfigDraft& draft) {
  std::set<Eigen::Index> chosen;  // each once, ascending
  if (is_word(node, "all")) {
    for (std::size_t i = 0; i < draft.config.faces.names.size(); ++i) {
      chosen.insert(static_cast<Eigen::Index>(i));
    }
  } else if (node.items.empty()) {
    draft.complaints.expected(node, "all or a list of heads and tags");
  }
  for (const YamlNode& item : node.items) {
    const auto name = read_name(item, draft.complaints);
    if (!name) continue;
    const auto heads = find_heads(*name, item.place, node.path, draft);
    chosen.insert(heads.begin(), heads.end());
  }
  return {chosen.begin(), chosen.end()};
}

std::string write_heads(const std::vector<Eigen::Index>& heads, const ConfigWriting& writing) {
  if (heads.size() == writing.config.faces.names.size()) return "all";
  std::vector<std::string> items;
  for (const Eigen::Index head : heads) items.push_back(writing.head(head));
  return flow_list(items);
}

std::vector<WeightedHead> read_weighted_heads(const YamlNode& node, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kMap && !node.entries.empty()) return read_weights(node, draft);
  std::vector<WeightedHead> heads;
  for (const Eigen::Index head : read_heads(node, draft)) heads.push_back({head, 1});
  return heads;
}

std::string write_weighted_heads(const std::vector<WeightedHead>& targets,
                                 const ConfigWriting& writing) {
  const bool weighted =
      std::ranges::any_of(targets, [](const WeightedHead& t) { return t.weight != 1; });
  if (weighted) return write_weights(targets, writing);
  std::vector<Eigen::Index> heads;
  for (const WeightedHead& target : targets) heads.push_back(target.head);
  return write_heads(heads, writing);
}

}  // namespace

Codec<std::vector<Eigen::Index>> head_list() {
  return {read_heads, write_heads};
}

Codec<std::vector<WeightedHead>> weighted_heads() {
  return {read_weighted_heads, write_weighted_heads};
}

}  // namespace crowdface
