// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/yaml_node.h"

#include <algorithm>

#include "crowdface/core/text.h"

namespace crowdface {

std::string YamlPlace::text() const {
  return line == 0 ? *source : concat(*source, ':', line, ':', column);
}

const YamlEntry* YamlNode::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &YamlEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNothing:
      return "no value";
    case YamlNode::Kind::kScalar:
      return quoted(node.text);
    case YamlNode::Kind::kList:
      return node.items.empty() ? "an empty list" : concat("a list of ", node.items.size());
    case YamlNode::Kind::kMap:
      return node.entries.empty() ? "an empty mapping" : "a mapping";
    case YamlNode::Kind::kRefused:
      break;
  }
  return "something refused";
}

}  // namespace crowdface
