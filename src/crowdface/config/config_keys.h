// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"

namespace crowdface {

/// One key of a section: a row from which it is known, read and written.
template <class Section>
struct Key {
  std::string_view name;
  /// Reads the value into the section. After a complaint the section may stay as it was.
  std::function<void(const YamlNode&, Section&, ConfigDraft&)> read;
  /// The value in YAML; empty: the key is left out. Paths are written relative to the folder.
  std::function<std::string(const Section&, const std::filesystem::path& folder)> write;
  std::string_view required = {};  ///< for a key that must be there: what would do
};

/// The keys of a section, in the order in which they are read and written.
template <class Section>
using Keys = std::vector<Key<Section>>;

const Keys<Config::Crowd>& crowd_keys();
const Keys<Config::Smoothing>& smoothing_keys();
const Keys<Config::Blending>& blending_keys();
const Keys<Config::Parts>& parts_keys();
const Keys<Config::Distance>& distance_keys();
const Keys<DiversityOptions>& diversity_keys();
const Keys<BelievabilityOptions>& believability_keys();
const Keys<Config::ContactSheet>& contact_sheet_keys();

/// Reads a mapping with these keys; null: none of them is there.
template <class Section>
void read_keys(const YamlNode* node, const Keys<Section>& keys, Section& section,
               ConfigDraft& draft) {
  std::vector<std::string> names;
  for (const Key<Section>& key : keys) names.emplace_back(key.name);
  const MapReader map(node, names, draft.complaints);
  for (const Key<Section>& key : keys) {
    const YamlNode* value =
        key.required.empty() ? map.find(key.name) : map.require(key.name, key.required);
    if (value != nullptr) key.read(*value, section, draft);
  }
}

/// A key whose value stands in one member, which may be an optional one.
/// \param read   (node, draft) → optional value, empty after a complaint.
/// \param write  value → YAML; a member that is empty is not written.
template <class Section, class Member, class Read, class Write>
Key<Section> key(std::string_view name, Member Section::*member, const Read& read,
                 const Write& write, std::string_view required = {}) {
  return {name,
          [=](const YamlNode& node, Section& section, ConfigDraft& draft) {
            if (auto value = read(node, draft))
              section.*member = static_cast<Member>(std::move(*value));
          },
          [=](const Section& section, const auto&) -> std::string {
            if constexpr (requires { (section.*member).has_value(); }) {
              return section.*member ? write(*(section.*member)) : "";
            } else {
              return write(section.*member);
            }
          },
          required};
}

/// One of the words of the member's type.
template <class Section, class Value>
Key<Section> word_key(std::string_view name, Value Section::*member) {
  return key(
      name, member,
      [](const YamlNode& node, ConfigDraft& draft) {
        return read_choice(node, words_of<Value>(), draft.complaints);
      },
      [](Value value) { return std::string(word_of(value)); });
}

/// A list of such words, each once. \param expected  "a list of views, [front, profile]".
template <class Section, class Value>
Key<Section> words_key(std::string_view name, std::vector<Value> Section::*member,
                       const std::string& expected) {
  const auto read = [=](const YamlNode& node,
                        ConfigDraft& draft) -> std::optional<std::vector<Value>> {
    if (node.kind == YamlNode::Kind::kList && !node.items.empty()) {
      return read_choices(node, words_of<Value>(), draft.complaints);
    }
    draft.complaints.expected(node, expected);
    return std::nullopt;
  };
  return key(name, member, read, flow_words<Value>);
}

/// A number, bounds included.
template <class Section>
Key<Section> number_key(std::string_view name, double Section::*member, double low, double high) {
  return key(
      name, member,
      [=](const YamlNode& node, ConfigDraft& draft) {
        return read_number(node, low, high, draft.complaints);
      },
      format_number);
}

/// A whole number, bounds included.
template <class Section, class Member>
Key<Section> whole_key(std::string_view name, Member Section::*member, std::uint64_t low,
                       std::uint64_t high, std::string_view required = {}) {
  const auto read = [=](const YamlNode& node, ConfigDraft& draft) {
    return read_whole(node, low, high, draft.complaints);
  };
  return key(
      name, member, read, [](auto whole) { return concat(whole); }, required);
}

/// A length from 0.
template <class Section>
Key<Section> length_key(std::string_view name, double Section::*member_mm, double high_mm) {
  return key(
      name, member_mm,
      [=](const YamlNode& node, ConfigDraft& draft) {
        return read_length_mm(node, high_mm, draft.complaints);
      },
      write_mm);
}

}  // namespace crowdface
