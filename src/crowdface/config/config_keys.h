// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/config/codec.h"

namespace crowdface {

struct StarterFacts;

/// What a starter config contains for one key: the key's value and its comments.
struct StarterLines {
  /// value that is passed to yaml_entry(); empty: only `comment_above` is written
  std::string value;
  std::string comment_beside = {};  ///< comment after the value, on the same line
  std::string comment_above = {};   ///< comment on the lines before the key
};
/// A function that returns what a starter config contains for one key. If the starter config does
/// not contain the key, the function returns nothing.
using Starter = std::function<std::optional<StarterLines>(const StarterFacts&)>;

/// A row of a table in docs/config.md. The row describes one key.
struct KeyRow {
  std::string section, key;     ///< `section`: path of the key's section; `key`: name of the key
  std::string accepted_values;  ///< the values that the key accepts
  std::string default_value;    ///< the default value, or "required"; empty if the key has neither
  bool affects_recipes = true;  ///< see Key::affects_recipes
};

template <class Section>
struct Key;
/// Returns the rows of the table in docs/config.md that describe `keys`.
template <class Section>
std::vector<KeyRow> key_rows(const std::string& section, const std::vector<Key<Section>>& keys,
                             const Section& initial);

/// One key of a config section: the key's name, functions that read and write its value, and its
/// documentation.
template <class Section>
struct Key {
  std::string_view name;
  /// Reads the key's value from a YAML node into the section. After a complaint, the section may be
  /// left unchanged.
  std::function<void(const YamlNode&, Section&, ConfigDraft&)> read;
  /// Returns the value in the section as a text that can be passed to yaml_entry(). If the text is
  /// empty, the key is left out.
  std::function<std::string(const Section&, const WriteContext&)> write;
  /// only for required keys: an example value, for the message when the key is missing
  std::string_view required_example = {};
  /// Returns what `crowdface init` writes for the key into a starter config. Empty: the key is not
  /// in a starter config.
  Starter make_starter_lines = {};
  std::string accepted_values = {};  ///< the accepted values, as docs/config.md describes them
  /// If the value is a mapping: returns the rows of the mapping's keys in docs/config.md.
  ///
  /// \param section  path of the mapping.
  std::function<std::vector<KeyRow>(const std::string& section)> rows = {};
  bool affects_face_files = true;  ///< false: no face file depends directly on the value
  /// false: no recipe depends on the value or on the files that the value names
  bool affects_recipes = true;

  /// Returns a copy of this key in which `make_lines` replaces the function `make_starter_lines`.
  Key with_starter_lines(const Starter& make_lines) const {
    Key key = *this;
    key.make_starter_lines = make_lines;
    return key;
  }
  /// Returns a copy of this key that always has these lines in a starter config.
  Key with_starter_lines(const StarterLines& lines) const {
    return with_starter_lines([=](const StarterFacts&) { return lines; });
  }
  /// Returns a copy of this key. For the copy, docs/config.md shows `values` as accepted values.
  Key with_accepted_values(const std::string& values) const {
    Key key = *this;
    key.accepted_values = values;
    return key;
  }
  /// Returns a copy of this key for a value that is a mapping: `rows` then returns the
  /// documentation rows of the mapping's keys.
  ///
  /// \param keys     keys of the mapping; must outlive the returned key.
  /// \param initial  section that contains the default values.
  template <class Inner>
  Key with_nested_keys(const std::vector<Key<Inner>>& keys, const Inner& initial = {}) const {
    Key key = *this;
    key.rows = [&keys, initial](const std::string& section) {
      return key_rows(section, keys, initial);
    };
    return key;
  }
  /// Returns a copy of this key with `affects_face_files` false. A new value of such a key does not
  /// make finished face files out of date. (Face files may still depend on the input files that the
  /// key names, and on the recipes that the key affects. Other digests cover these files and
  /// recipes.)
  Key not_affecting_face_files() const {
    Key key = *this;
    key.affects_face_files = false;
    return key;
  }
  /// Returns a copy of this key with `affects_recipes` false: users may change the key after the
  /// crowd is finished.
  Key not_affecting_recipes() const {
    Key key = *this;
    key.affects_recipes = false;
    return key;
  }
  /// Returns a copy of this key that is written only if `condition(section, context)` is true.
  template <class Condition>
  Key written_if(const Condition& condition) const {
    Key key = *this;
    key.write = [condition, write = write](const Section& section, const WriteContext& context) {
      return condition(section, context) ? write(section, context) : "";
    };
    return key;
  }
};

/// The keys of a section, in the order in which the keys are read and written.
template <class Section>
using Keys = std::vector<Key<Section>>;

template <class Section>
std::vector<std::string> names_of(const Keys<Section>& keys) {
  return texts_of(keys, [](const Key<Section>& key) { return key.name; });
}

/// Returns the text of one key in a starter config: the lines of `comment_above`, then
/// "key: value   # comment_beside". A line break precedes each line.
std::string starter_lines(std::string_view key, const StarterLines& lines);

/// Reads a mapping with these keys into the section.
///
/// \return whether the node is a mapping.
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

/// Returns "key: value" for each key that `context.written_keys` selects. Leaves out keys whose
/// value is an empty text. Also leaves out keys that have their default value, unless
/// `context.written_keys` is kAll.
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
    const bool is_left_out = !is_whole && value == key.write(Section{}, context);
    if (!value.empty() && !is_left_out) entries.push_back(yaml_entry(key.name, value));
  }
  return entries;
}

/// Returns a value as docs/config.md shows it, in one line. If the value may differ between
/// regions, its text begins with a line break and "default: ". The function removes this beginning.
std::string one_line_text(std::string_view value);

/// Returns the documentation rows of a section's keys and of all keys nested in them.
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
    const std::vector<KeyRow> nested_rows = key.rows(path);
    rows.insert(rows.end(), nested_rows.begin(), nested_rows.end());
  }
  return rows;
}

/// Returns the documentation rows of all documented keys of a config.
std::vector<KeyRow> config_key_rows();
/// Returns the paths of the keys that are marked with Key::not_affecting_recipes, such as "output".
std::set<std::string> keys_not_affecting_recipes();

/// Writes a list of sections as a YAML list of mappings. All sections of the list have the same
/// keys.
template <class Section>
std::string write_sections(const Keys<Section>& keys, const std::vector<Section>& sections,
                           const WriteContext& context) {
  return yaml_block_list(texts_of(sections, [&](const Section& section) {
    return yaml_block_map(write_keys(keys, section, context));
  }));
}

/// Returns the value of a section in a starter config: the starter lines of all keys of the
/// section. Returns an empty text if no key has starter lines.
template <class Section>
std::string starter_keys(const Keys<Section>& keys, const StarterFacts& facts) {
  std::string text;
  for (const Key<Section>& key : keys) {
    const auto lines = key.make_starter_lines ? key.make_starter_lines(facts) : std::nullopt;
    if (lines) text += starter_lines(key.name, *lines);
  }
  return text;
}

/// Returns the Starter of a section, a key whose value is a mapping with the keys `keys`. The
/// Starter is a function. It returns the starter lines of all `keys`, joined by starter_keys, as
/// the value of the section. If none of the `keys` has starter lines, it returns nothing, and the
/// starter config does not contain the section.
///
/// \param keys           must outlive the returned function.
/// \param comment_above  comment on the lines before the section; empty: none.
template <class Section>
Starter starter_section(const Keys<Section>& keys, const std::string& comment_above = {}) {
  return [=, &keys](const StarterFacts& facts) -> std::optional<StarterLines> {
    const std::string lines = starter_keys(keys, facts);
    if (lines.empty()) return std::nullopt;
    return StarterLines{lines, {}, comment_above};
  };
}

/// Makes a key whose value is stored in one member of the section. If the member is an empty
/// optional, the key is not written.
template <class Section, class Member, class Value>
Key<Section> key(std::string_view name, Member Section::*member, const Codec<Value>& codec,
                 std::string_view required_example = {}) {
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
          required_example,
          {},
          codec.accepted_values};
}

/// A function that checks a section after the section has been read.
///
/// \param is_valid  whether reading the section added no complaint.
using SectionCheck = void (*)(const YamlNode& node, bool is_valid, ConfigDraft& draft);

/// Makes a key whose value is a mapping with the given keys.
///
/// \param member  the member that stores the value, directly or in an Indirect.
template <class Section, class Member, class Value>
Key<Section> section_key(std::string_view name, Member Section::*member, const Keys<Value>& keys,
                         std::string_view required_example = {}, SectionCheck check = nullptr) {
  const auto value_in = [member](auto& section) -> auto& {
    if constexpr (std::is_same_v<Member, Value>) {
      return section.*member;
    } else {
      return *(section.*member);
    }
  };
  return {name,
          [=, &keys](const YamlNode& node, Section& section, ConfigDraft& draft) {
            const std::size_t complaints_before = draft.complaints.size();
            read_keys(node, keys, value_in(section), draft);
            if (check) check(node, draft.complaints.size() == complaints_before, draft);
          },
          [=, &keys](const Section& section, const WriteContext& context) {
            return yaml_block_map(write_keys(keys, value_in(section), context));
          },
          required_example,
          starter_section(keys),
          {},
          [=, &keys](const std::string& path) {
            const Section initial;
            return key_rows(path, keys, value_in(initial));
          }};
}

/// Makes a key whose value is one of the words of the enumeration `Value` (see words_of).
template <class Section, class Value>
Key<Section> word_key(std::string_view name, Value Section::*member,
                      std::string_view required_example = {}) {
  return key(name, member, word<Value>(), required_example);
}

/// The top-level keys of a config, in the order in which the keys are read. The functions below
/// return similar tables for the sections.
const Keys<Config>& root_keys();
const Keys<Config::Distance>& distance_keys();
const Keys<DiversityOptions>& diversity_keys();
const Keys<SamplingOptions>& sampling_keys();
const Keys<Config::Output>& output_keys();
/// This function and the following functions make the top-level keys whose values are sections.
Key<Config> faces_key();
Key<Config> regions_key();
Key<Config> shapes_key();
Key<Config> neck_key();
Key<Config> attachments_key();
Key<Config> believability_key();
Key<Config> recipes_key();
Key<Config> groups_key();
/// A starter config may divide the crowd into two groups, women and men. Returns the number of
/// heads of the sex with fewer heads; 0 if the starter config has no groups.
std::size_t head_count_of_rarer_sex(const StarterFacts& facts);
Key<Config> families_key();
/// Makes the key `none` of a group. The section `attachments` must have been read.
Key<Group> none_of_group_key();
Key<Config> changes_key();
/// Reads the changes of single faces that a config or a review requests.
std::vector<FaceChange> read_changes(const YamlNode& node, ConfigDraft& draft);
/// Writes changes as a mapping whose keys are faces.
std::string write_changes(const std::vector<FaceChange>& changes, const WriteContext& context);
/// Reads the list of regions and bands to lock. Returns ascending indices into region_band_names().
/// Each entry of the list is a region (all its bands), a band (in all regions), or one band of one
/// region.
std::vector<std::size_t> read_locked_bands(const YamlNode& node, ConfigDraft& draft);
/// Returns whether a sampled face of this config's crowd has this id.
bool is_sampled_face_id(const std::string& id, const Config& config);
/// Returns whether any face of this config's crowd has this id: a sampled face, a face written by
/// hand, or a face of a family.
bool is_face_id(const std::string& id, const Config& config);
/// Returns the ids of a family's members and of the parents that casting makes for the family.
std::vector<std::string> face_ids_of_family(const FamilyOptions& family, const std::string& crowd);
/// Makes the key `hair_colours` of a section: for each named hair colour, the fraction of the faces
/// that have this colour.
template <class Section>
Key<Section> hair_colours_key(std::map<std::string, double> Section::*shares) {
  const auto is_not_empty = [=](const Section& section, const auto&) {
    return !(section.*shares).empty();
  };
  return key("hair_colours", shares, hair_colours()).written_if(is_not_empty);
}
/// Reads a mapping from heads to weights, {head: weight}.
void read_head_weights(const YamlNode& node, std::vector<WeightedHead>& weights,
                       ConfigDraft& draft);
/// Reads the value of the key `colours`: the colour weights of the heads.
void read_colours(const YamlNode& node, std::vector<WeightedHead>& weights, ConfigDraft& draft);
/// Makes the key `colours` of a section: the heads that lend textures to a face, and their weights.
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
/// Reads the value of the key `review`, and the review files that this value names.
void read_review(const YamlNode& node, Config& config, ConfigDraft& draft);
/// Writes the value of the key `review`: the list of the review files.
std::string write_review(const Config& config, const WriteContext& context);

}  // namespace crowdface
