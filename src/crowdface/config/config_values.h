// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/complaints.h"
#include "crowdface/config/words.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/text.h"

namespace crowdface {

/// The entries of one mapping. Unknown keys are complained of when it is made.
class MapReader {
 public:
  /// \param node  null: the mapping is not there, and neither is any key.
  MapReader(const YamlNode* node, std::vector<std::string> keys, Complaints& complaints);

  /// Whether the key is there, be it without a value.
  bool has(std::string_view key) const { return node_ != nullptr && node_->find(key) != nullptr; }
  /// The key's value; null if the key is not there or (a complaint) has no value.
  const YamlNode* find(std::string_view key) const;
  /// The same; a key that is not there is a complaint. `hint` says what would do.
  const YamlNode* require(std::string_view key, std::string_view hint) const;

 private:
  const YamlNode* node_;
  Complaints& complaints_;
};

/// Each reads one value and returns nothing after a complaint. Bounds are inclusive.
std::optional<double> read_number(const YamlNode& node, double low, double high, Complaints& out);
std::optional<std::uint64_t> read_whole(const YamlNode& node, std::uint64_t low, std::uint64_t high,
                                        Complaints& out);
std::optional<double> read_length_mm(const YamlNode& node, double high_mm, Complaints& out);
/// The same above 0 mm; a complaint leaves what stands there.
void read_positive_mm(const YamlNode& node, double high_mm, double& value_mm, Complaints& out);
/// A text without control characters that is not empty. \param expected  "a file name".
std::optional<std::string> read_text(const YamlNode& node, const std::string& expected,
                                     Complaints& out);
/// A text that can be part of a file name on any system, and cannot lead to another folder.
std::optional<std::string> read_name(const YamlNode& node, Complaints& out);
std::optional<PlanePoint> read_point(const YamlNode& node, Complaints& out);
/// One value or [low, high]; `read` reads one of them.
std::optional<Range> read_range(const YamlNode& node, Complaints& out,
                                const std::function<std::optional<double>(const YamlNode&)>& read);

/// Which of the words it is.
std::optional<std::size_t> read_word(const YamlNode& node, const std::vector<std::string>& words,
                                     Complaints& out);

/// The value of one of the words.
template <class Words>
auto read_choice(const YamlNode& node, const Words& words, Complaints& out) {
  std::vector<std::string> texts;
  for (const auto& word : words) texts.emplace_back(word.text);
  const auto index = read_word(node, texts, out);
  return index ? std::optional(words[*index].value) : std::nullopt;
}

/// The value of one of its type's words; what stands there is left where the key is missing or
/// after a complaint.
template <class Value>
void read_choice_into(const YamlNode* node, Value& value, Complaints& out) {
  if (node != nullptr) value = read_choice(*node, words_of<Value>(), out).value_or(value);
}

/// A list of words, each once. \param node  a list.
template <class Words>
auto read_choices(const YamlNode& node, const Words& words, Complaints& out) {
  std::vector<decltype(words[0].value)> values;
  for (const YamlNode& item : node.items) {
    const auto value = read_choice(item, words, out);
    if (!value) continue;
    if (std::find(values.begin(), values.end(), *value) != values.end()) {
      out.about(item, concat(quoted(item.text), " is named twice"));
    }
    values.push_back(*value);
  }
  return values;
}

/// Each writes one value, or a list or mapping of them in one line: "[a, b]".
std::string flow_list(const std::vector<std::string>& items);
std::string flow_map(const std::vector<std::string>& entries);
std::string flow_names(const std::vector<std::string>& names);
template <class Value>
std::string flow_words(const std::vector<Value>& values) {
  std::vector<std::string> items;
  for (const Value value : values) items.emplace_back(word_of(value));
  return flow_list(items);
}
std::string write_mm(double value_mm);
/// A path relative to the folder, which is absolute.
std::string write_path(const std::filesystem::path& file, const std::filesystem::path& folder);

/// `; did you mean "count"?`, or nothing if no candidate is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace crowdface
