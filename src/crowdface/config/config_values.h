// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/complaints.h"
#include "crowdface/config/yaml.h"

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

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// The value of one of the words.
template <class Value>
std::optional<Value> read_choice(const YamlNode& node, const Choices<Value>& choices,
                                 Complaints& out) {
  std::vector<std::string> words;
  for (const auto& choice : choices) words.push_back(choice.first);
  const auto index = read_word(node, words, out);
  return index ? std::optional<Value>(choices[*index].second) : std::nullopt;
}

/// `; did you mean "count"?`, or nothing if no candidate is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace crowdface
