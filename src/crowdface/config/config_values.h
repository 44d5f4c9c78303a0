// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/complaints.h"
#include "crowdface/config/words.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/text.h"

namespace crowdface {

/// largest distance between two heads or faces that a config may give, in mm
inline constexpr double kMaxDistanceMm = 1000;

/// Finds values in one mapping by their keys. The constructor adds a complaint for each unknown
/// key.
class MapReader {
 public:
  /// \param node  must outlive the reader. If the node is not a mapping, the constructor adds one
  ///              complaint, and find() and require() return null without further complaints.
  /// \param keys  all known keys of the mapping.
  MapReader(const YamlNode& node, const std::vector<std::string>& keys, Complaints& complaints);

  /// Returns the value of a key; null if the key is missing. If the key is there but has no value,
  /// returns null and adds a complaint.
  const YamlNode* find(std::string_view key) const;
  /// Like find(), but also adds a complaint if the key is missing.
  ///
  /// \param hint  an example value, for the message.
  const YamlNode* require(std::string_view key, std::string_view hint) const;

 private:
  const YamlNode& node_;
  Complaints& complaints_;
};

/// Each of these functions reads one value. If the value is not accepted, the function adds a
/// complaint and returns nothing. Bounds are inclusive.
std::optional<double> read_number(const YamlNode& node, double low, double high, Complaints& out);
std::optional<std::uint64_t> read_whole_number(const YamlNode& node, std::uint64_t low,
                                               std::uint64_t high, Complaints& out);
/// Reads a text that is not empty and contains no control characters.
///
/// \param expected  what messages name as the expected value, such as "a file name".
std::optional<std::string> read_text(const YamlNode& node, const std::string& expected,
                                     Complaints& out);
/// Reads a name that can be part of a file name on every system: it contains no path separator, for
/// example.
std::optional<std::string> read_name(const YamlNode& node, Complaints& out);

/// Returns a list that contains the text `text(item)` for each of `items`.
template <class Items, class Text>
std::vector<std::string> texts_of(const Items& items, const Text& text) {
  std::vector<std::string> texts;
  for (const auto& item : items) texts.emplace_back(text(item));
  return texts;
}

/// Adds a complaint that the node's value is none of the expected `words`. The caller has found
/// that this is the case.
void expect_one_of(const YamlNode& node, const std::vector<std::string>& words, Complaints& out);
/// Reads a word. If the word is in `words`, returns the value that the word stands for. Otherwise,
/// adds a complaint and returns nothing.
template <class Value>
std::optional<Value> read_choice(const YamlNode& node, const Words<Value>& words, Complaints& out) {
  const auto texts = texts_of(words, [](const Word<Value>& word) { return word.text; });
  const auto found = std::ranges::find(texts, node.text);
  if (node.kind == YamlNode::Kind::kScalar && found != texts.end()) {
    return words[static_cast<std::size_t>(found - texts.begin())].value;
  }
  expect_one_of(node, texts, out);
  return std::nullopt;
}

/// Adds a complaint about each item of a list that repeats the text of an earlier item.
void refuse_repeated(const YamlNode& list, Complaints& out);
/// Returns whether the node is a scalar with this text, such as "none".
bool is_word(const YamlNode& node, std::string_view word);
bool has_control_character(std::string_view text);

/// Returns the factor that scales shares to a sum of at most 1. People round shares up to whole
/// percents (three times 0.34), so the sum may exceed 1 by less than 0.01 for each share above 0;
/// the factor is then 1 / sum. Returns nothing if the sum is larger.
std::optional<double> factor_of_rounded_shares(const std::vector<double>& shares);

/// Formats a number, rounded to a whole number, without an exponent: -1000000, not -1e+06.
std::string plain_number(double value);

/// Returns a list in YAML's flow style, in one line: "[a, b]".
std::string yaml_flow_list(const std::vector<std::string>& items);
/// Returns a mapping in YAML's flow style, in one line: "{a: 1, b: 2}".
///
/// \param entries  texts such as "a: 1", from yaml_entry.
std::string yaml_flow_map(const std::vector<std::string>& entries);
/// Returns a list of names in flow style; names that YAML would misread are quoted.
std::string yaml_flow_list_of_names(const std::vector<std::string>& names);
/// Returns a list in YAML's block style, with one line for each item; "[]" if there are no items.
/// If an item is itself in block style, indents its lines.
std::string yaml_block_list(const std::vector<std::string>& items);
/// Returns a mapping in YAML's block style, with one line for each entry; "{}" if there are no
/// entries.
///
/// \param entries  texts such as "a: 1", from yaml_entry.
std::string yaml_block_map(const std::vector<std::string>& entries);
/// Returns an entry of a YAML mapping, "key: value". If the value is in block style, indents its
/// lines.
std::string yaml_entry(std::string_view key, std::string_view value);

/// Returns `; did you mean "count"?`, where "count" is the candidate most similar to the word.
/// Returns an empty text if no candidate is similar.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// Like suggestion(), but lists the candidates, if they are few, when none is similar.
std::string suggestion_or_choices(std::string_view word,
                                  const std::vector<std::string>& candidates);

}  // namespace crowdface
