// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The material bindings and collections of a USD layer: the properties `material:binding…` and
/// `collection:…` of its prims (schemas MaterialBindingAPI and CollectionAPI).
class UsdaBindings {
 public:
  /// Adds a property if it is part of a binding or of a collection.
  /// \param prim      path of the prim, such as "/head/skin".
  /// \param property  name of the property, such as "material:binding:collection:skin".
  /// \param values    the paths or the token that the property lists.
  /// \param strength  value of the metadata `bindMaterialAs`; may be empty.
  void add(const std::string& prim, const std::string& property,
           const std::vector<std::string>& values, const std::string& strength);

  /// The path of the material bound to a prim; empty if there is none. The prim and the prims above
  /// it may have bindings. The binding nearest to the prim wins, unless a binding farther up has
  /// the strength `strongerThanDescendants`. If one prim has several bindings, the bindings through
  /// collections win. Bindings of the purpose `full` count only if no other binding applies.
  std::string material_of(std::string_view prim) const;

 private:
  /// A property that belongs to a binding or a collection.
  struct Property {
    std::vector<std::string> values;  ///< the paths or the token that the property lists
    /// whether the binding overrides the bindings of the prim's descendants
    bool is_stronger = false;
  };
  /// The properties of a prim by name.
  using Properties = std::map<std::string, Property, std::less<>>;

  /// Whether a collection contains a prim.
  /// \param collection  path of the collection, such as "/head.collection:skin".
  /// \param depth  nesting depth of the collection: 0 for the collection of a binding, one more for
  ///               each collection that an outer collection includes.
  bool has_prim(std::string_view collection, std::string_view prim, int depth) const;
  /// The strongest binding in `properties` that applies to `prim`; null if there is none.
  /// \param properties  of `prim` or of a prim above it.
  /// \param full  true: considers only bindings of the purpose `full`; false: only other bindings.
  const Property* binding_at(const Properties& properties, std::string_view prim, bool full) const;

  /// maps the path of each prim to its properties
  std::map<std::string, Properties, std::less<>> prims_;
};

}  // namespace crowdface
