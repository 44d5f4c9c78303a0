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

inline constexpr double kMaxDistance = 1000;  ///< between heads, mm

/// The entries of one mapping. Unknown keys are complained of when it is made.
class MapReader {
 public:
  /// \param node  if it is no mapping (a complaint), it has none of the keys, and none is missing.
  MapReader(const YamlNode& node, const std::vector<std::string>& keys, Complaints& complaints);

  /// The key's value; null if the key is not there or (a complaint) has no value.
  const YamlNode* find(std::string_view key) const;
  /// The same; a key that is not there is a complaint. `hint` says what would do.
  const YamlNode* require(std::string_view key, std::string_view hint) const;

 private:
  const YamlNode& node_;
  Complaints& complaints_;
};

/// Each reads one value and returns nothing after a complaint. Bounds are inclusive.
std::optional<double> read_number(const YamlNode& node, double low, double high, Complaints& out);
std::optional<std::uint64_t> read_whole(const YamlNode& node, std::uint64_t low, std::uint64_t high,
                                        Complaints& out);
/// A text without control characters that is not empty. \param expected  "a file name".
std::optional<std::string> read_text(const YamlNode& node, const std::string& expected,
                                     Complaints& out);
/// A text that can be part of a file name on any system, and cannot lead to another folder.
std::optional<std::string> read_name(const YamlNode& node, Complaints& out);

/// What `text` makes of each item.
template <class Items, class Text>
std::vector<std::string> texts_of(const Items& items, const Text& text) {
  std::vector<std::string> texts;
  for (const auto& item : items) texts.emplace_back(text(item));
  return texts;
}

/// Complains that the node is none of the words.
void expected_one_of(const YamlNode& node, const std::vector<std::string>& words, Complaints& out);
/// The value of one of the words.
template <class Value>
std::optional<Value> read_choice(const YamlNode& node, const Words<Value>& words, Complaints& out) {
  const auto texts = texts_of(words, [](const Word<Value>& word) { return word.text; });
  const auto found = std::ranges::find(texts, node.text);
  if (node.kind == YamlNode::Kind::kScalar && found != texts.end()) {
    return words[static_cast<std::size_t>(found - texts.begin())].value;
  }
  expected_one_of(node, texts, out);
  return std::nullopt;
}

/// Complains of items of a list that are the same text.
void refuse_repeated(const YamlNode& list, Complaints& out);
bool is_word(const YamlNode& node, std::string_view word);
bool has_control_character(std::string_view text);

/// A bound without exponent: -1000000, not -1e+06.
std::string plain_number(double value);

/// A list or mapping in one line, "[a, b]".
std::string flow_list(const std::vector<std::string>& items);
std::string flow_map(const std::vector<std::string>& entries);
std::string flow_names(const std::vector<std::string>& names);
/// The same, a line each, for entry() and block_list() to set further in; "[]" if it is empty.
std::string block_list(const std::vector<std::string>& items);
std::string block_map(const std::vector<std::string>& entries);
/// "key: value".
std::string entry(std::string_view key, std::string_view value);

/// `; did you mean "count"?`, or nothing if no candidate is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace crowdface
