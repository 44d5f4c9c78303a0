// SPDX-License-Identifier: Apache-2.0
// The section `parts`.
#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

std::vector<std::string> read_part_names(const YamlNode* node, Complaints& complaints) {
  std::vector<std::string> names;
  if (node == nullptr) return names;
  constexpr const char* kExpected = "a list of materials, groups or \"component N\"";
  if (node->kind != YamlNode::Kind::kList) {
    complaints.expected(*node, kExpected);
    return names;
  }
  for (const YamlNode& item : node->items) {
    if (auto name = read_text(item, "a material, a group or \"component N\"", complaints)) {
      names.push_back(std::move(*name));
    }
  }
  return names;
}

}  // namespace

void read_parts(const YamlNode* node, ConfigDraft& draft) {
  Config::Parts& parts = draft.config.parts;
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kScalar) {
    const auto word = read_word(*node, {"auto", "none"}, draft.complaints);
    parts.follow = word != std::size_t{1};
    return;
  }
  const MapReader map(node, {"shape", "skin", "rigid", "bound", "together"}, draft.complaints);
  if (const YamlNode* shape = map.find("shape")) {
    const Choices<PartShape> choices = {{"target", PartShape::kTarget},
                                        {"blend", PartShape::kBlend}};
    parts.shape = read_choice(*shape, choices, draft.complaints).value_or(PartShape::kTarget);
  }
  parts.skin = read_part_names(map.find("skin"), draft.complaints);
  parts.rigid = read_part_names(map.find("rigid"), draft.complaints);
  parts.bound = read_part_names(map.find("bound"), draft.complaints);
  const YamlNode* together = map.find("together");
  if (together == nullptr) return;
  if (together->kind != YamlNode::Kind::kList) {
    draft.complaints.expected(*together, "a list of lists of materials, groups or \"component N\"");
    return;
  }
  for (const YamlNode& item : together->items) {
    parts.together.push_back(read_part_names(&item, draft.complaints));
  }
}

}  // namespace crowdface
