// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_draft.h"
#include "crowdface/config/config_values.h"
#include "crowdface/core/units.h"

namespace crowdface {

/// The context in which values are written as YAML.
struct WriteContext {
  /// The keys to write: all keys, or the keys that face_settings or plan_settings needs.
  enum class WrittenKeys { kAll, kFaces, kPlan };
  const Config& config;
  std::filesystem::path folder;  ///< absolute; written paths are relative to this folder
  WrittenKeys written_keys = WrittenKeys::kAll;

  /// Returns the head's name as a YAML scalar.
  std::string head(Eigen::Index index) const;
};

/// Converts values between YAML and C++. If `read` returns nothing, it has added a complaint.
/// `write` returns text for entry(); if the text is empty, the key is left out of the file.
template <class Value>
struct Codec {
  std::function<std::optional<Value>(const YamlNode&, ConfigDraft&)> read;
  std::function<std::string(const Value&, const WriteContext&)> write;
  std::string accepted_values = {};  ///< the accepted values, for docs/config.md: "number, 0 … 1"
};

/// Removes a leading "a " or "an ": "a list of tags" becomes "list of tags".
std::string remove_article(std::string_view expected);

/// A number in [low, high].
Codec<double> number(double low, double high);
/// A whole number in [low, high].
Codec<std::uint64_t> whole(std::uint64_t low, std::uint64_t high);
/// The length of one mesh unit: mm, cm, m, in, or a length such as "243.84 cm".
Codec<LengthUnit> length_unit();
/// A length with its unit, in [0, high_mm]. The value is in millimetres.
Codec<double> length(double high_mm);
/// Like `length`, but refuses 0.
Codec<double> positive_length(double high_mm);
/// Like `codec`, but refuses 0. \param expected  text for messages, such as "a number above 0".
Codec<double> refuse_zero(const Codec<double>& codec, const std::string& expected);
/// One value, or a range `[low, high]`.
Codec<Range> range(const Codec<double>& one);
Codec<Range> asymmetry();  ///< 0 to kMaxAsymmetry
Codec<Range> age();        ///< −1 to 1; needs heads with the tag `young` below 0, `old` above 0
Codec<Range> extrapolation();  ///< factor, −kMaxExtrapolation to kMaxExtrapolation
/// A smoothness as a fraction (0 to 1) or as a size with its unit, or a range of either.
Codec<SmoothnessDistribution> smoothness();
/// A smoothness as a whole number of smoothing iterations, or a range of such numbers.
Codec<SmoothnessDistribution> iterations();
Codec<std::string> name();
/// A text that is not empty. \param expected  for messages, such as "an image file".
Codec<std::string> text(const std::string& expected);
Codec<Eigen::Index> head();
/// Heads by name or tag, or `all`. The result is ascending, without duplicates.
Codec<std::vector<Eigen::Index>> head_list();
/// Like `head_list` (every weight is 1), or a mapping `{head or tag: weight}`.
Codec<std::vector<WeightedHead>> weighted_heads();
Codec<PlanePoint> point();
/// Writes weights as "{head: weight}".
std::string write_weights(const std::vector<WeightedHead>& weights, const WriteContext& context);
/// A mapping from names of hair colours to fractions whose sum is at most 1: {red: 0.3}.
Codec<std::map<std::string, double>> hair_colours();
/// A path relative to the config's folder. An empty path is not written.
/// \param expected  for messages, such as "a folder".
Codec<std::filesystem::path> path(const std::string& expected);
/// An existing OBJ file.
Codec<std::filesystem::path> obj_file();

/// Restricts a codec to values that pass a check.
/// \param fits  called with (value, node, draft); adds a complaint and returns false to refuse.
template <class Value, class Fits>
Codec<Value> restricted(Codec<Value> codec, const Fits& fits) {
  codec.read = [=, read = std::move(codec.read)](const YamlNode& node, ConfigDraft& draft) {
    auto value = read(node, draft);
    if (value && !fits(*value, node, draft)) value.reset();
    return value;
  };
  return codec;
}

/// Lists the words of an enumeration for docs/config.md: "`front`, `skin`".
template <class Value>
std::string quoted_words() {
  return join(texts_of(words_of<Value>(),
                       [](const Word<Value>& word) { return concat('`', word.text, '`'); }));
}

/// A value that a config names by a word, see all_words.
template <class Value>
Codec<Value> word() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            return read_choice(node, words_of<Value>(), draft.complaints);
          },
          [](Value value, const WriteContext&) { return std::string(word_of(value)); },
          quoted_words<Value>()};
}

/// A list of values, written in one line. \param expected  for messages, such as "a list of tags".
template <class Value>
Codec<std::vector<Value>> list(const Codec<Value>& item, const std::string& expected) {
  return {[=](const YamlNode& node, ConfigDraft& draft) {
            std::vector<Value> values;
            draft.complaints.expect_list(node, expected);
            for (const YamlNode& child : node.items) {
              if (auto value = item.read(child, draft)) values.push_back(std::move(*value));
            }
            return std::optional(values);
          },
          [=](const std::vector<Value>& values, const WriteContext& context) {
            return flow_list(
                texts_of(values, [&](const Value& value) { return item.write(value, context); }));
          },
          remove_article(expected)};
}

/// A list of words without duplicates.
/// \param expected   for messages, such as "a list of views, [front, profile]".
/// \param min_count  minimum number of words.
template <class Value>
Codec<std::vector<Value>> words(const std::string& expected, std::size_t min_count = 1) {
  auto codec = list(word<Value>(), expected);
  codec.accepted_values = concat("list of ", quoted_words<Value>(), ", each once");
  codec.read = [=, read = codec.read](const YamlNode& node,
                                      ConfigDraft& draft) -> std::optional<std::vector<Value>> {
    if (node.kind != YamlNode::Kind::kList || node.items.size() < min_count) {
      return draft.complaints.expected(node, expected);
    }
    refuse_repeated(node, draft.complaints);
    return read(node, draft);
  };
  return codec;
}

}  // namespace crowdface
