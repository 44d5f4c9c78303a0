// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_difference.h"

#include "crowdface/config/config.h"
#include "crowdface/config/yaml.h"

namespace crowdface {
namespace {

/// Returns the first node of `b` that is missing in `a` or has another value there. If there is
/// none, returns the first node of `a` that is missing in `b`, or null.
/// \param defaults  values for keys that `a` lacks because an older version wrote `a`; may be null.
const YamlNode* first_difference(const YamlNode& a, const YamlNode& b, const YamlNode* defaults) {
  if (a.kind != b.kind || a.text != b.text || a.items.size() != b.items.size()) return &b;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    if (first_difference(a.items[i], b.items[i], nullptr) != nullptr) return &b;
  }
  for (const YamlEntry& entry : b.entries) {
    const YamlEntry* own_default = defaults == nullptr ? nullptr : defaults->find(entry.key);
    const YamlNode* value = own_default == nullptr ? nullptr : &own_default->value;
    const YamlEntry* old = a.find(entry.key);
    const YamlNode* before = old == nullptr ? value : &old->value;
    if (before == nullptr) return &entry.value;
    if (const YamlNode* found = first_difference(*before, entry.value, value)) return found;
  }
  for (const YamlEntry& entry : a.entries) {
    if (b.find(entry.key) == nullptr) return &entry.value;
  }
  return nullptr;
}

/// Removes the key `review`: a crowd's folder stores its reviews, and later runs may add to them.
void forget_reviews(YamlNode& root) {
  std::erase_if(root.entries, [](const YamlEntry& entry) { return entry.key == "review"; });
}

}  // namespace

std::optional<std::string> config_difference(const std::string& old_text, const std::string& text) {
  if (old_text == text) return std::nullopt;
  Complaints complaints;
  auto old = parse_yaml(old_text, "", complaints);
  auto root = parse_yaml(text, "", complaints);
  if (!old || !root || !complaints.empty())
    return "every key, because one of the two is not a valid config";
  forget_reviews(*old);
  forget_reviews(*root);
  const auto defaults = parse_yaml(effective_config(Config{}, "/"), "", complaints);
  const YamlNode* found = first_difference(*old, *root, defaults ? &*defaults : nullptr);
  if (found == nullptr) return std::nullopt;
  return found->path.empty() ? "its keys" : found->path;
}

}  // namespace crowdface
