// SPDX-License-Identifier: Apache-2.0
// The section `parts`.
#include "crowdface/config/config_keys.h"

namespace crowdface {
namespace {

std::vector<std::string> read_part_names(const YamlNode& node, Complaints& complaints) {
  std::vector<std::string> names;
  constexpr const char* kExpected = "a list of materials, groups or \"component N\"";
  if (!complaints.expect_list(node, kExpected)) return names;
  for (const YamlNode& item : node.items) {
    if (auto name = read_text(item, "a material, a group or \"component N\"", complaints)) {
      names.push_back(std::move(*name));
    }
  }
  return names;
}

Key<Config::Parts> part_names_key(std::string_view name,
                                  std::vector<std::string> Config::Parts::*member) {
  return key(
      name, member,
      [](const YamlNode& node, ConfigDraft& draft) {
        return std::optional(read_part_names(node, draft.complaints));
      },
      flow_names);
}

void read_together(const YamlNode& node, Config::Parts& parts, ConfigDraft& draft) {
  if (!draft.complaints.expect_list(node,
                                    "a list of lists of materials, groups or \"component N\""))
    return;
  for (const YamlNode& item : node.items) {
    parts.together.push_back(read_part_names(item, draft.complaints));
  }
}

std::string write_together(const Config::Parts& parts, const std::filesystem::path&) {
  std::vector<std::string> together;
  for (const auto& names : parts.together) together.push_back(flow_names(names));
  return flow_list(together);
}

}  // namespace

const Keys<Config::Parts>& parts_keys() {
  using Parts = Config::Parts;
  static const Keys<Parts> keys = {word_key("shape", &Parts::shape),
                                   part_names_key("skin", &Parts::skin),
                                   part_names_key("rigid", &Parts::rigid),
                                   part_names_key("bound", &Parts::bound),
                                   {"together", read_together, write_together}};
  return keys;
}

void read_parts(const YamlNode* node, ConfigDraft& draft) {
  Config::Parts& parts = draft.config.parts;
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kScalar) {
    const auto word = read_word(*node, {"auto", "none"}, draft.complaints);
    parts.follow = word != std::size_t{1};
    return;
  }
  read_keys(node, parts_keys(), parts, draft);
}

}  // namespace crowdface
