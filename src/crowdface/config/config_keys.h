// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/codec.h"

namespace crowdface {

struct StarterFacts;

/// A key and its comments in a starter config.
struct StarterLines {
  std::string value;                ///< value for entry(); empty: only `comment_above` is written
  std::string comment_beside = {};  ///< comment on the same line
  std::string comment_above = {};   ///< comment before the key, one or more lines
};
using Starter = std::function<std::optional<StarterLines>(const StarterFacts&)>;

/// A row of the tables in docs/config.md.
struct KeyRow {
  std::string section, key;
  std::string accepted_values;  ///< accepted values
  std::string default_value;    ///< default value; "required"; or empty if there is no default
  bool affects_recipes = true;  ///< see Key::affects_recipes
};

template <class Section>
struct Key;
template <class Section>
std::vector<KeyRow> key_rows(const std::string& section, const std::vector<Key<Section>>& keys,
                             const Section& initial);

/// One key of a section: its name, how to read and write its value, and its documentation.
template <class Section>
struct Key {
  std::string_view name;
  /// Reads the value into the section. After a complaint the section may be unchanged.
  std::function<void(const YamlNode&, Section&, ConfigDraft&)> read;
  /// Returns the section's value as text for entry(); an empty text leaves the key out.
  std::function<std::string(const Section&, const WriteContext&)> write;
  std::string_view required_example = {};  ///< required keys only: an example, for the message
  Starter starter = {};                    ///< empty: the key is not in a starter config
  std::string accepted_values = {};        ///< accepted values, for docs/config.md
  /// Documents the nested keys, if the value is a mapping. \param section  path of that mapping.
  std::function<std::vector<KeyRow>(const std::string& section)> rows = {};
  bool affects_face_files = true;  ///< false: the value itself never affects a face's files
  bool affects_recipes = true;  ///< false: no recipe depends on the value or on the files it names

  Key with_starter(const Starter& lines) const {
    Key key = *this;
    key.starter = lines;
    return key;
  }
  Key with_starter(const StarterLines& lines) const {
    return with_starter([=](const StarterFacts&) { return lines; });
  }
  Key with_accepted_values(const std::string& values) const {
    Key key = *this;
    key.accepted_values = values;
    return key;
  }
  /// Documents a value that is a mapping. \param keys  keys of that mapping; must outlive this key.
  template <class Inner>
  Key with_nested_keys(const std::vector<Key<Inner>>& keys, const Inner& initial = {}) const {
    Key key = *this;
    key.rows = [&keys, initial](const std::string& section) {
      return key_rows(section, keys, initial);
    };
    return key;
  }
  /// Marks a key whose value no face file depends on directly. Other digests cover the input files
  /// that the key names, and the recipes that the key leads to.
  Key ignored_by_face_files() const {
    Key key = *this;
    key.affects_face_files = false;
    return key;
  }
  /// Marks a key that may change in a finished crowd, because no recipe depends on the key.
  Key ignored_by_recipes() const {
    Key key = *this;
    key.affects_recipes = false;
    return key;
  }
  /// Writes the key only if `is(section, writing)` holds.
  template <class Is>
  Key written_if(const Is& is) const {
    Key key = *this;
    key.write = [is, write = write](const Section& section, const WriteContext& context) {
      return is(section, context) ? write(section, context) : "";
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

/// Returns `comment_above`, then "key: value   # comment_beside"; each line starts with '\n'.
std::string starter_lines(std::string_view key, const StarterLines& lines);

/// Reads a mapping with these keys into the section. \return whether the node is a mapping.
template <class Section>
bool read_keys(const YamlNode& node, const Keys<Section>& keys, Section& section,
               ConfigDraft& draft) {
  const MapReader map(node, names_of(keys), draft.complaints);
  for (const Key<Section>& key : keys) {
    const YamlNode* value = key.required_example.empty()
                                ? map.find(key.name)
                                : map.require(key.name, key.required_example);
    if (value != nullptr) key.read(*value, section, draft);
  }
  return node.kind == YamlNode::Kind::kMap;
}

/// Returns "key: value" for each key of `context.written_keys` whose text is not empty. Unless all keys are
/// written, skips keys at their default.
template <class Section>
std::vector<std::string> write_keys(const Keys<Section>& keys, const Section& section,
                                    const WriteContext& context) {
  std::vector<std::string> entries;
  for (const Key<Section>& key : keys) {
    const bool is_whole = context.written_keys == WriteContext::WrittenKeys::kAll;
    if (context.written_keys == WriteContext::WrittenKeys::kFaces && !key.affects_face_files)
      continue;
    if (context.written_keys == WriteContext::WrittenKeys::kPlan && !key.affects_recipes) continue;
    const std::string value = key.write(section, context);
    const bool left_out = !is_whole && value == key.write(Section{}, context);
    if (!value.empty() && !left_out) entries.push_back(entry(key.name, value));
  }
  return entries;
}

/// Shortens a value to one line for docs/config.md: removes a leading "default: ".
std::string one_line_text(std::string_view value);

/// Returns the rows of a section's keys and of all nested keys.
template <class Section>
std::vector<KeyRow> key_rows(const std::string& section, const Keys<Section>& keys,
                             const Section& initial) {
  std::vector<KeyRow> rows;
  const Config defaults;
  for (const Key<Section>& key : keys) {
    if (!key.accepted_values.empty() || !key.affects_recipes) {
      rows.push_back({section, std::string(key.name), key.accepted_values,
                      key.required_example.empty()
                          ? one_line_text(key.write(initial, {defaults, {}}))
                          : "required",
                      key.affects_recipes});
    }
    if (!key.rows) continue;
    const std::string path =
        section.empty() ? std::string(key.name) : concat(section, '.', key.name);
    const std::vector<KeyRow> own = key.rows(path);
    rows.insert(rows.end(), own.begin(), own.end());
  }
  return rows;
}

/// Returns the rows of all documented keys of a config.
std::vector<KeyRow> config_key_rows();
/// Returns the paths of the keys marked with Key::ignored_by_recipes, such as "output".
std::set<std::string> keys_ignored_by_recipes();

/// Writes a list of sections that have the same keys.
template <class Section>
std::string write_sections(const Keys<Section>& keys, const std::vector<Section>& sections,
                           const WriteContext& context) {
  return block_list(texts_of(sections, [&](const Section& section) {
    return block_map(write_keys(keys, section, context));
  }));
}

/// Writes the section's keys that have a starter, as the value of that section; empty if none has.
template <class Section>
std::string starter_keys(const Keys<Section>& keys, const StarterFacts& facts) {
  std::string text;
  for (const Key<Section>& key : keys) {
    const auto lines = key.starter ? key.starter(facts) : std::nullopt;
    if (lines) text += starter_lines(key.name, *lines);
  }
  return text;
}

/// Makes the starter of a section with these keys, which must outlive the starter.
template <class Section>
Starter starter_section(const Keys<Section>& keys, const std::string& above = {}) {
  return [=, &keys](const StarterFacts& facts) -> std::optional<StarterLines> {
    const std::string lines = starter_keys(keys, facts);
    if (lines.empty()) return std::nullopt;
    return StarterLines{lines, {}, above};
  };
}

/// A key whose value is stored in one member. An empty optional is not written.
template <class Section, class Member, class Value>
Key<Section> key(std::string_view name, Member Section::*member, const Codec<Value>& codec,
                 std::string_view required = {}) {
  return {name,
          [=](const YamlNode& node, Section& section, ConfigDraft& draft) {
            if (auto value = codec.read(node, draft))
              section.*member = static_cast<Member>(std::move(*value));
          },
          [=](const Section& section, const WriteContext& context) -> std::string {
            if constexpr (requires { (section.*member).has_value(); }) {
              return section.*member ? codec.write(static_cast<Value>(*(section.*member)), context)
                                     : "";
            } else {
              return codec.write(static_cast<Value>(section.*member), context);
            }
          },
          required,
          {},
          codec.accepted_values};
}

/// Checks a section after it has been read. \param is_valid  whether reading added no complaint.
using SectionCheck = void (*)(const YamlNode& node, bool is_valid, ConfigDraft& draft);

/// A key whose value is a mapping with the given keys.
template <class Section, class Member>
Key<Section> section_key(std::string_view name, Member Section::*member, const Keys<Member>& keys,
                         std::string_view required = {}, SectionCheck check = nullptr) {
  return {
      name,
      [=, &keys](const YamlNode& node, Section& section, ConfigDraft& draft) {
        const std::size_t complaints_before = draft.complaints.size();
        read_keys(node, keys, section.*member, draft);
        if (check) check(node, draft.complaints.size() == complaints_before, draft);
      },
      [=, &keys](const Section& section, const WriteContext& context) {
        return block_map(write_keys(keys, section.*member, context));
      },
      required,
      starter_section(keys),
      {},
      [&keys, member](const std::string& path) { return key_rows(path, keys, Section{}.*member); }};
}

template <class Section, class Value>
Key<Section> word_key(std::string_view name, Value Section::*member,
                      std::string_view required = {}) {
  return key(name, member, word<Value>(), required);
}

/// The top-level keys of a config, in the order in which they are read. Each section has a similar
/// table.
const Keys<Config>& root_keys();
const Keys<Config::Distance>& distance_keys();
const Keys<DiversityOptions>& diversity_keys();
const Keys<SamplingOptions>& sampling_keys();
const Keys<Config::Output>& output_keys();
Key<Config> faces_key();
Key<Config> regions_key();
Key<Config> shapes_key();
Key<Config> neck_key();
Key<Config> attachments_key();
Key<Config> believability_key();
Key<Config> recipes_key();
Key<Config> groups_key();
/// Returns the number of heads in the smaller of a starter config's two groups, women and men; 0 if
/// the starter has no groups.
std::size_t heads_of_smaller_group(const StarterFacts& facts);
Key<Config> families_key();
Key<Config> changes_key();
/// Reads the changes of single faces that a config or a review asks for.
std::vector<FaceChange> read_changes(const YamlNode& node, ConfigDraft& draft);
/// Writes changes as a mapping from faces.
std::string write_changes(const std::vector<FaceChange>& changes, const WriteContext& context);
/// Reads a list of regions, bands or bands of regions, as ascending part numbers: region · #bands +
/// band.
std::vector<std::size_t> read_locked_parts(const YamlNode& node, ConfigDraft& draft);
/// Whether a sampled face (any face) of this config's crowd has this id.
bool is_sampled_face(const std::string& id, const Config& config);
bool is_face(const std::string& id, const Config& config);
/// Returns the ids of a family's members and of its sampled parents.
std::vector<std::string> face_ids_of_family(const FamilyOptions& family, const std::string& crowd);
/// The key `hair_colours` of a section: fractions of the faces by the name of their hair colour.
template <class Section>
Key<Section> hair_colours_key(std::map<std::string, double> Section::*shares) {
  const auto some = [=](const Section& section, const auto&) { return !(section.*shares).empty(); };
  return key("hair_colours", shares, hair_colours()).written_if(some);
}
/// Reads a mapping from heads to weights, {head: weight}.
void read_head_weights(const YamlNode& node, std::vector<WeightedHead>& weights,
                       ConfigDraft& draft);
void read_colours(const YamlNode& node, std::vector<WeightedHead>& weights, ConfigDraft& draft);
/// The key `colours` of a section: the heads that lend textures.
template <class Section>
Key<Section> colours_key(std::vector<WeightedHead> Section::*weights) {
  return Key<Section>{
      "colours",
      [=](const YamlNode& node, Section& section, ConfigDraft& draft) {
        read_colours(node, section.*weights, draft);
      },
      [=](const Section& section, const WriteContext& context) {
        return (section.*weights).empty() ? "" : write_weights(section.*weights, context);
      }}
      .with_accepted_values("`{head: weight}`");
}
void read_review(const YamlNode& node, Config& config, ConfigDraft& draft);
std::string write_review(const Config& config, const WriteContext& context);

}  // namespace crowdface
