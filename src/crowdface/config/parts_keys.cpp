// SPDX-License-Identifier: Apache-2.0
// The section `parts`.
#include "crowdface/config/config_keys.h"

namespace crowdface {
namespace {

using Parts = Config::Parts;

const Keys<Parts>& parts_keys() {
  const auto names = list(text("a material, a group or \"component N\""),
                          "a list of materials, groups or \"component N\"");
  static const Keys<Parts> keys = {
      word_key("shape", &Parts::shape), key("skin", &Parts::skin, names),
      key("rigid", &Parts::rigid, names), key("bound", &Parts::bound, names),
      key("together", &Parts::together,
          list(names, "a list of lists of materials, groups or \"component N\""))};
  return keys;
}

}  // namespace

void read_parts(const YamlNode& node, Config& config, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kScalar) {
    const Words<bool> words = {{"auto", true}, {"none", false}};
    config.parts.follow = read_choice(node, words, draft.complaints).value_or(true);
  } else {
    read_keys(node, parts_keys(), config.parts, draft);
  }
}

std::string write_parts(const Config& config, const ConfigWriting& writing) {
  if (!config.parts.follow) return "none";
  return block_map(write_keys(parts_keys(), config.parts, writing));
}

}  // namespace crowdface
