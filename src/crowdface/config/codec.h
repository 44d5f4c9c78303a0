// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_draft.h"
#include "crowdface/config/config_values.h"
#include "crowdface/core/units.h"

namespace crowdface {

/// What a value may need to know to be written.
struct ConfigWriting {
  const Config& config;
  std::filesystem::path folder;  ///< absolute; paths are written relative to it
  bool only_for_faces = false;   ///< see face_settings

  /// The name of a head, as YAML.
  std::string head(Eigen::Index index) const;
};

/// How a value stands in YAML: reading it, which returns nothing after a complaint, and writing it
/// as entry() takes it. Where the text is empty the key is left out.
template <class Value>
struct Codec {
  std::function<std::optional<Value>(const YamlNode&, ConfigDraft&)> read;
  std::function<std::string(const Value&, const ConfigWriting&)> write;
  std::string takes = {};  ///< the values, for docs/config.md: "number, 0 … 1"
};

/// "list of tags" for "a list of tags".
std::string without_article(std::string_view expected);

/// A number, bounds included.
Codec<double> number(double low, double high);
/// A whole number, bounds included.
Codec<std::uint64_t> whole(std::uint64_t low, std::uint64_t high);
/// What one unit of a mesh is: mm, cm, m, in, or a length.
Codec<LengthUnit> length_unit();
/// A length in millimetres from 0, or above it.
Codec<double> length(double high_mm);
Codec<double> positive_length(double high_mm);
/// What this one reads but for 0. \param expected  "a number above 0".
Codec<double> above_zero(const Codec<double>& codec, const std::string& expected);
/// One value, or [low, high].
Codec<Range> range(const Codec<double>& one);
Codec<Range> asymmetry();      ///< from 0
Codec<Range> age();            ///< from −1 to 1; needs heads that are tagged so
Codec<Range> extrapolation();  ///< a factor
/// A smoothness as fraction or size, or a range of either.
Codec<SmoothnessDistribution> smoothness();
/// Whole iterations or a range of them.
Codec<SmoothnessDistribution> iterations();
Codec<std::string> name();
/// A text that is not empty; `expected` as in "an image file".
Codec<std::string> text(const std::string& expected);
Codec<Eigen::Index> head();
/// Heads by name or tag, or `all`. Ascending, each once.
Codec<std::vector<Eigen::Index>> head_list();
/// The same, or `{name: weight}`.
Codec<std::vector<WeightedHead>> weighted_heads();
Codec<PlanePoint> point();
/// "{head: weight}".
std::string write_weights(const std::vector<WeightedHead>& weights, const ConfigWriting& writing);
/// A path, relative to the config's folder; `expected` as in "a folder". The empty one is left out.
Codec<std::filesystem::path> path(const std::string& expected);
/// An OBJ file that is there.
Codec<std::filesystem::path> obj_file();

/// The values of a codec that fit. \param fits  whether (value, node, draft) does; complains if not.
template <class Value, class Fits>
Codec<Value> such_that(Codec<Value> codec, const Fits& fits) {
  codec.read = [=, read = std::move(codec.read)](const YamlNode& node, ConfigDraft& draft) {
    auto value = read(node, draft);
    if (value && !fits(*value, node, draft)) value.reset();
    return value;
  };
  return codec;
}

/// "`front`, `skin`".
template <class Value>
std::string shown_words() {
  return join(texts_of(words_of<Value>(),
                       [](const Word<Value>& word) { return concat('`', word.text, '`'); }));
}

/// One of the words of the type.
template <class Value>
Codec<Value> word() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            return read_choice(node, words_of<Value>(), draft.complaints);
          },
          [](Value value, const ConfigWriting&) { return std::string(word_of(value)); },
          shown_words<Value>()};
}

/// A list of values that each stand in one line.
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
          [=](const std::vector<Value>& values, const ConfigWriting& writing) {
            return flow_list(
                texts_of(values, [&](const Value& value) { return item.write(value, writing); }));
          },
          without_article(expected)};
}

/// A list of words, each once. \param expected  "a list of views, [front, profile]".
template <class Value>
Codec<std::vector<Value>> words(const std::string& expected, std::size_t fewest = 1) {
  auto codec = list(word<Value>(), expected);
  codec.takes = concat("list of ", shown_words<Value>(), ", each once");
  codec.read = [=, read = codec.read](const YamlNode& node,
                                      ConfigDraft& draft) -> std::optional<std::vector<Value>> {
    if (node.kind != YamlNode::Kind::kList || node.items.size() < fewest) {
      return draft.complaints.expected(node, expected);
    }
    refuse_repeated(node, draft.complaints);
    return read(node, draft);
  };
  return codec;
}

}  // namespace crowdface
