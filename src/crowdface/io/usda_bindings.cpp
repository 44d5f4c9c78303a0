// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_bindings.h"

#include <algorithm>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::string_view kDirect = "material:binding", kPreview = "material:binding:preview",
                           kFull = "material:binding:full",
                           kThroughCollection = "material:binding:collection:",
                           kFullThroughCollection = "material:binding:collection:full:";

std::string_view parent_of(std::string_view path) {
  return path.substr(0, path.rfind('/'));
}

}  // namespace

void UsdaBindings::add(const std::string& prim, const std::string& property,
                       const std::vector<std::string>& values, const std::string& strength) {
  if (!property.starts_with(kDirect) && !property.starts_with("collection:")) return;
  prims_[prim][property] = {values, strength == "strongerThanDescendants"};
}

bool UsdaBindings::has_prim(std::string_view collection, std::string_view prim, int depth) const {
  constexpr int kDeepest = 20;  // stops the recursion if collections include each other
  const std::size_t dot = std::min(collection.find('.'), collection.size());
  const auto owner = prims_.find(collection.substr(0, dot));
  if (owner == prims_.end() || dot == collection.size() || depth > kDeepest) return false;
  const auto has = [&](std::string_view suffix, std::string_view value) {
    const auto found = owner->second.find(concat(collection.substr(dot + 1), ':', suffix));
    return found != owner->second.end() &&
           std::ranges::find(found->second.values, value) != found->second.values.end();
  };
  const bool is_explicit = has("expansionRule", "explicitOnly");
  for (std::string_view path = prim; !path.empty(); path = parent_of(path)) {
    if (has("excludes", path)) return false;
    if (has("includes", path)) return true;
    if (is_explicit) break;
  }
  if (has("includeRoot", "1") || has("includeRoot", "true")) return true;
  const auto includes = owner->second.find(concat(collection.substr(dot + 1), ":includes"));
  return includes != owner->second.end() &&
         std::ranges::any_of(includes->second.values, [&](const std::string& included) {
           return has_prim(included, prim, depth + 1);
         });
}

const UsdaBindings::Property* UsdaBindings::binding_at(const Properties& properties,
                                                       std::string_view prim, bool full) const {
  for (auto at = properties.lower_bound(kThroughCollection);
       at != properties.end() && at->first.starts_with(kThroughCollection); ++at) {
    if (at->first.starts_with(kFullThroughCollection) != full) continue;
    const std::vector<std::string>& values = at->second.values;  // the collection, the material
    if (values.size() == 2 && has_prim(values[0], prim, 0)) return &at->second;
  }
  for (const std::string_view name : {full ? kFull : kPreview, full ? kFull : kDirect}) {
    const auto direct = properties.find(name);
    if (direct != properties.end() && !direct->second.values.empty()) return &direct->second;
  }
  return nullptr;
}

std::string UsdaBindings::material_of(std::string_view prim) const {
  std::string material;
  for (const bool full : {false, true}) {
    for (std::string_view path = prim; !path.empty(); path = parent_of(path)) {
      const auto properties = prims_.find(path);
      if (properties == prims_.end()) continue;
      const Property* binding = binding_at(properties->second, prim, full);
      if (binding == nullptr) continue;
      if (material.empty() || binding->is_stronger) material = binding->values.back();
    }
    if (!material.empty()) break;
  }
  return material;
}

}  // namespace crowdface
