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

/// The context in which a codec writes a value as YAML.
struct WriteContext {
  /// Which keys to write: all keys, the keys that face_settings_yaml writes, or the keys that
  /// plan_settings_yaml writes.
  enum class WrittenKeys { kAll, kFaces, kPlan };
  const Config& config;
  std::filesystem::path folder;  ///< an absolute path; written paths are relative to this folder
  WrittenKeys written_keys = WrittenKeys::kAll;

  /// Returns the name of the head with this index, as a YAML scalar.
  std::string head(Eigen::Index index) const;
};

/// Converts values between YAML and C++. If `read` cannot read a value, it adds a complaint and
/// returns nothing. `write` returns a text that can be passed to yaml_entry(). If the text is
/// empty, the key is left out of the file.
template <class Value>
struct Codec {
  std::function<std::optional<Value>(const YamlNode&, ConfigDraft&)> read;
  std::function<std::string(const Value&, const WriteContext&)> write;
  /// the accepted values for docs/config.md, such as "number, 0 … 1"
  std::string accepted_values = {};
};

/// Removes a leading article, "a " or "an ": "a list of tags" becomes "list of tags".
std::string remove_article(std::string_view expected);

/// Codec for a number in [low, high].
Codec<double> number(double low, double high);
/// Codec for a whole number in [low, high].
Codec<std::uint64_t> whole_number(std::uint64_t low, std::uint64_t high);
/// Codec for the length of one mesh unit: see kUnitChoices.
Codec<LengthUnit> length_unit();
/// Codec for a length with a unit. The value is converted to millimetres, and must be in [0,
/// high_mm].
Codec<double> length(double high_mm);
/// Codec for a length with a unit. The value is converted to millimetres, must be above 0, and must
/// be at most high_mm.
Codec<double> positive_length(double high_mm);
/// Like `codec`, but refuses 0.
///
/// \param expected  what messages name as the expected value, such as "a number above 0".
Codec<double> nonzero(const Codec<double>& codec, const std::string& expected);
/// Codec for a range, given as `[low, high]` or as one value, which is then both ends.
Codec<Range> range(const Codec<double>& value_codec);
/// Codec for a range of the asymmetry: the factor that multiplies a face's left-right differences,
/// from 0 to kMaxAsymmetry.
Codec<Range> asymmetry();
/// Codec for an age from −1 (young) to 1 (old), for an age in years ("70 years"), or for a range.
/// Refuses ages below 0 if no head has the tag `young`, and ages above 0 if no head has the tag
/// `old`. Refuses an age in years if the age of any head is unknown, or if the age is outside the
/// range of the heads' ages.
Codec<AgeRange> age();
/// Codec for a range of the extrapolation factor e, from −kMaxExtrapolation to kMaxExtrapolation.
Codec<Range> extrapolation();
/// Codec for a smoothness, given as a fraction (0 to 1), as a size with a unit, or as a range of
/// fractions or sizes.
Codec<SmoothnessDistribution> smoothness();
/// Codec for a smoothness, given as a whole number of smoothing iterations or as a range of such
/// numbers.
Codec<SmoothnessDistribution> smoothness_in_iterations();
/// Codec for a name; see read_name.
Codec<std::string> name();
/// Codec for a text that is not empty.
///
/// \param expected  what messages name as the expected value, such as "an image file".
Codec<std::string> text(const std::string& expected);
/// Codec for a head, given by its name.
Codec<Eigen::Index> head();
/// Codec for a list of heads, each given by its name or by a tag, or `all`. The result is ascending
/// and has no duplicates.
Codec<std::vector<Eigen::Index>> head_list();
/// Codec for heads with weights, given as a mapping `{head or tag: weight}` or as a list (see
/// head_list; every weight is then 1).
Codec<std::vector<WeightedHead>> weighted_heads();
/// Codec for a point of the weight plane, given as `[x, y]`.
Codec<PlanePoint> plane_point();
/// Writes weights as "{head: weight}".
std::string write_weights(const std::vector<WeightedHead>& weights, const WriteContext& context);
/// Codec for a mapping from names of hair colours to fractions that sum to at most 1: {red: 0.3}.
Codec<std::map<std::string, double>> hair_colours();
/// Codec for a path relative to the config's folder. An empty path is not written.
///
/// \param expected  what messages name as the expected value, such as "a folder".
Codec<std::filesystem::path> path(const std::string& expected);
/// Codec for the path of an existing OBJ file.
Codec<std::filesystem::path> obj_file();

/// Makes a codec that accepts only values that pass a check.
///
/// \param fits  called with (value, node, draft); to refuse a value, it adds a complaint and
///              returns false.
template <class Value, class Fits>
Codec<Value> restricted(Codec<Value> codec, const Fits& fits) {
  codec.read = [=, read = std::move(codec.read)](const YamlNode& node, ConfigDraft& draft) {
    auto value = read(node, draft);
    if (value && !fits(*value, node, draft)) value.reset();
    return value;
  };
  return codec;
}

/// Returns the words of an enumeration for docs/config.md, such as "`front`, `skin`".
template <class Value>
std::string quoted_words() {
  return join(texts_of(words_of<Value>(),
                       [](const Word<Value>& word) { return concat('`', word.text, '`'); }));
}

/// Codec for a value of an enumeration, which a config gives as a word; see all_words.
template <class Value>
Codec<Value> word() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            return read_choice(node, words_of<Value>(), draft.complaints);
          },
          [](Value value, const WriteContext&) { return std::string(word_of(value)); },
          quoted_words<Value>()};
}

/// Codec for a list of values, written in one line.
///
/// \param expected  what messages name as the expected value, such as "a list of tags".
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
            return yaml_flow_list(
                texts_of(values, [&](const Value& value) { return item.write(value, context); }));
          },
          remove_article(expected)};
}

/// Codec for a list of words without duplicates.
///
/// \param expected   what messages name as the expected value, such as "a list of views, [front,
///                   profile]".
/// \param min_count  smallest allowed number of words.
template <class Value>
Codec<std::vector<Value>> words(const std::string& expected, std::size_t min_count = 1) {
  auto codec = list(word<Value>(), expected);
  codec.accepted_values = concat("list of ", quoted_words<Value>(), ", each once");
  codec.read = [=, read = codec.read](const YamlNode& node,
                                      ConfigDraft& draft) -> std::optional<std::vector<Value>> {
    if (node.kind != YamlNode::Kind::kList || node.items.size() < min_count) {
      return draft.complaints.add_mismatch(node, expected);
    }
    refuse_repeated(node, draft.complaints);
    return read(node, draft);
  };
  return codec;
}

}  // namespace crowdface
