// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/codec.h"

namespace crowdface {

struct StarterFacts;

/// A key in a starter config.
struct StarterLines {
  std::string value;        ///< as entry() takes it; empty: only the comment above stands there
  std::string beside = {};  ///< a comment behind it
  std::string above = {};   ///< one before it, of one or more lines
};
using Starter = std::function<std::optional<StarterLines>(const StarterFacts&)>;

/// One key of a section: a row from which it is known, read and written.
template <class Section>
struct Key {
  std::string_view name;
  /// Reads the value into the section. After a complaint the section may stay as it was.
  std::function<void(const YamlNode&, Section&, ConfigDraft&)> read;
  /// Likewise as entry() takes it; empty: the key is left out.
  std::function<std::string(const Section&, const ConfigWriting&)> write;
  std::string_view required = {};  ///< for a key that must be there: what would do
  Starter starter = {};            ///< none: it is not in a starter config

  Key in_starter(const Starter& lines) const {
    Key key = *this;
    key.starter = lines;
    return key;
  }
  Key in_starter(const StarterLines& lines) const {
    return in_starter([=](const StarterFacts&) { return lines; });
  }
  /// Of other sections the key is left out.
  template <class Is>
  Key written_if(const Is& is) const {
    Key key = *this;
    key.write = [is, write = write](const Section& section, const ConfigWriting& writing) {
      return is(section, writing) ? write(section, writing) : "";
    };
    return key;
  }
};

/// The keys of a section, in the order in which they are read and written.
template <class Section>
using Keys = std::vector<Key<Section>>;

template <class Section>
std::vector<std::string> names_of(const Keys<Section>& keys) {
  return texts_of(keys, [](const Key<Section>& key) { return key.name; });
}

/// "key: value   # beside" under its comment, each line after an '\n'.
std::string starter_lines(std::string_view key, const StarterLines& lines);

/// Reads a mapping with these keys. \return whether it is one.
template <class Section>
bool read_keys(const YamlNode& node, const Keys<Section>& keys, Section& section,
               ConfigDraft& draft) {
  const MapReader map(node, names_of(keys), draft.complaints);
  for (const Key<Section>& key : keys) {
    const YamlNode* value =
        key.required.empty() ? map.find(key.name) : map.require(key.name, key.required);
    if (value != nullptr) key.read(*value, section, draft);
  }
  return node.kind == YamlNode::Kind::kMap;
}

/// "key: value" for each key that is not left out.
template <class Section>
std::vector<std::string> write_keys(const Keys<Section>& keys, const Section& section,
                                    const ConfigWriting& writing) {
  std::vector<std::string> entries;
  for (const Key<Section>& key : keys) {
    const std::string value = key.write(section, writing);
    if (!value.empty()) entries.push_back(entry(key.name, value));
  }
  return entries;
}

/// A list of such sections.
template <class Section>
std::string write_sections(const Keys<Section>& keys, const std::vector<Section>& sections,
                           const ConfigWriting& writing) {
  return block_list(texts_of(sections, [&](const Section& section) {
    return block_map(write_keys(keys, section, writing));
  }));
}

/// The keys that a starter config has, as the value of their section; empty if it has none.
template <class Section>
std::string starter_keys(const Keys<Section>& keys, const StarterFacts& facts) {
  std::string text;
  for (const Key<Section>& key : keys) {
    const auto lines = key.starter ? key.starter(facts) : std::nullopt;
    if (lines) text += starter_lines(key.name, *lines);
  }
  return text;
}

/// Of a section whose keys are these.
template <class Section>
Starter starter_section(const Keys<Section>& keys, const std::string& above = {}) {
  return [=, &keys](const StarterFacts& facts) -> std::optional<StarterLines> {
    const std::string lines = starter_keys(keys, facts);
    if (lines.empty()) return std::nullopt;
    return StarterLines{lines, {}, above};
  };
}

/// A key whose value stands in one member. A member that is an empty optional is not written.
template <class Section, class Member, class Value>
Key<Section> key(std::string_view name, Member Section::*member, const Codec<Value>& codec,
                 std::string_view required = {}) {
  return {name,
          [=](const YamlNode& node, Section& section, ConfigDraft& draft) {
            if (auto value = codec.read(node, draft))
              section.*member = static_cast<Member>(std::move(*value));
          },
          [=](const Section& section, const ConfigWriting& writing) -> std::string {
            if constexpr (requires { (section.*member).has_value(); }) {
              return section.*member ? codec.write(static_cast<Value>(*(section.*member)), writing)
                                     : "";
            } else {
              return codec.write(static_cast<Value>(section.*member), writing);
            }
          },
          required,
          {}};
}

/// What is looked at once a section is read. \param sound  whether it had no complaint.
using SectionCheck = void (*)(const YamlNode& node, bool sound, ConfigDraft& draft);

/// A key whose value is a mapping with keys of its own.
template <class Section, class Member>
Key<Section> section_key(std::string_view name, Member Section::*member, const Keys<Member>& keys,
                         std::string_view required = {}, SectionCheck check = nullptr) {
  return {name,
          [=, &keys](const YamlNode& node, Section& section, ConfigDraft& draft) {
            const std::size_t complaints_before = draft.complaints.size();
            read_keys(node, keys, section.*member, draft);
            if (check) check(node, draft.complaints.size() == complaints_before, draft);
          },
          [=, &keys](const Section& section, const ConfigWriting& writing) {
            return block_map(write_keys(keys, section.*member, writing));
          },
          required, starter_section(keys)};
}

template <class Section, class Value>
Key<Section> word_key(std::string_view name, Value Section::*member,
                      std::string_view required = {}) {
  return key(name, member, word<Value>(), required);
}

/// The keys of a config: its sections. Each has its keys in a table like this one.
const Keys<Config>& root_keys();
const Keys<Config::Distance>& distance_keys();
const Keys<DiversityOptions>& diversity_keys();
const Keys<SamplingOptions>& sampling_keys();
const Keys<Config::Output>& output_keys();
void read_faces(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_faces(const Config& config, const ConfigWriting& writing);
std::optional<StarterLines> faces_starter(const StarterFacts& facts);
void read_regions(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_regions(const Config& config, const ConfigWriting& writing);
std::optional<StarterLines> regions_starter(const StarterFacts& facts);
void read_shapes(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_shapes(const Config& config, const ConfigWriting& writing);
void read_attachments(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_attachments(const Config& config, const ConfigWriting& writing);
std::optional<StarterLines> attachments_starter(const StarterFacts& facts);
void read_believability(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_believability(const Config& config, const ConfigWriting& writing);
Starter believability_starter();
void read_recipes(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_recipes(const Config& config, const ConfigWriting& writing);
void read_groups(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_groups(const Config& config, const ConfigWriting& writing);
std::optional<StarterLines> groups_starter(const StarterFacts& facts);
/// The ids of a family's members, and of parents who are drawn.
std::vector<std::string> ids_of(const FamilyOptions& family, const std::string& crowd);
void read_families(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_families(const Config& config, const ConfigWriting& writing);
void read_review(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_review(const Config& config, const ConfigWriting& writing);
}  // namespace crowdface
