// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/codec.h"

#include <algorithm>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

using Unit = SmoothnessDistribution::Unit;

/// A codec of values that need nothing but their YAML.
template <class Value, class Read, class Write>
Codec<Value> plain(const Read& read, const Write& write) {
  return {[=](const YamlNode& node, ConfigDraft& draft) { return read(node, draft.complaints); },
          [=](const Value& value, const ConfigWriting&) { return std::string(write(value)); }};
}

bool is_size(const YamlNode& node) {
  return node.kind == YamlNode::Kind::kScalar && parse_length_mm(node.text);
}

Codec<double> fraction() {
  Codec<double> codec = number(0, 1);
  codec.read = [=, number = codec.read](const YamlNode& node,
                                        ConfigDraft& draft) -> std::optional<double> {
    if (node.kind != YamlNode::Kind::kScalar || parse_double(node.text)) return number(node, draft);
    draft.complaints.expected(node, "a fraction from 0 to 1 or a size, such as \"8 mm\"");
    return std::nullopt;
  };
  return codec;
}

/// A size that smoothing reaches.
Codec<double> relief_size() {
  return such_that(length(1e9), [](double size, const YamlNode& node, ConfigDraft& draft) {
    const Config::Smoothing& smoothing = draft.config.smoothing;
    const bool bounded = draft.smoothing_known && !smoothing.max_iterations;
    if (!bounded || size <= smoothing.max_size_mm) return true;
    draft.complaints.expected(
        node, concat("a size up to smoothing.max_size, ", smoothing.max_size_mm, " mm"));
    return false;
  });
}

/// Kept as a number; written whole: 1e+07 is no whole number to the reader.
Codec<double> iteration_count() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<double> {
            const std::uint64_t most =
                draft.config.smoothing.max_iterations.value_or(kMaxIterations);
            const auto count = read_whole(node, 0, most, draft.complaints);
            return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
          },
          [](double count, const auto&) { return concat(static_cast<std::uint64_t>(count)); }};
}

}  // namespace

std::string ConfigWriting::head(Eigen::Index index) const {
  return write_scalar(config.faces.names[static_cast<std::size_t>(index)]);
}

Codec<double> number(double low, double high) {
  return plain<double>(
      [=](const YamlNode& node, Complaints& out) { return read_number(node, low, high, out); },
      format_number);
}

Codec<std::uint64_t> whole(std::uint64_t low, std::uint64_t high) {
  return plain<std::uint64_t>(
      [=](const YamlNode& node, Complaints& out) { return read_whole(node, low, high, out); },
      [](std::uint64_t value) { return concat(value); });
}

Codec<double> length(double high_mm) {
  return plain<double>(
      [=](const YamlNode& node, Complaints& out) { return read_length_mm(node, high_mm, out); },
      [](double value_mm) { return concat(value_mm, " mm"); });
}

Codec<double> positive_length(double high_mm) {
  return above_zero(length(high_mm), "a length above 0 mm");
}

Codec<double> above_zero(const Codec<double>& codec, const std::string& expected) {
  return such_that(codec, [=](double value, const YamlNode& node, ConfigDraft& draft) {
    if (value == 0) draft.complaints.expected(node, expected);
    return value != 0;
  });
}

Codec<Range> range(const Codec<double>& one) {
  return {[=](const YamlNode& node, ConfigDraft& draft) {
            return read_range(node, draft.complaints,
                              [&](const YamlNode& item) { return one.read(item, draft); });
          },
          [=](const Range& range, const ConfigWriting& writing) {
            const std::string low = one.write(range.low, writing);
            return range.low == range.high ? low : flow_list({low, one.write(range.high, writing)});
          }};
}

Codec<Range> age() {
  return such_that(range(number(-1, 1)), [](Range age, const YamlNode& node, ConfigDraft& draft) {
    const auto has = [&](const std::vector<Eigen::Index>& heads, const char* tag) {
      if (!heads.empty() || !draft.tags_known || !draft.heads_known) return true;
      draft.complaints.about(node, concat("no head is tagged ", tag, " under faces.tags"));
      return false;
    };
    const bool has_old = age.high <= 0 || has(draft.config.sampling.old_heads, "old");
    return (age.low >= 0 || has(draft.config.sampling.young_heads, "young")) && has_old;
  });
}

Codec<Range> asymmetry() {
  return range(number(0, kMaxAsymmetry));
}

Codec<Range> extrapolation() {
  return range(number(-kMaxExtrapolation, kMaxExtrapolation));
}

Codec<SmoothnessDistribution> smoothness() {
  return {[fractions = range(fraction()), sizes = range(relief_size())](
              const YamlNode& node, ConfigDraft& draft) -> std::optional<SmoothnessDistribution> {
            const bool is_list = node.kind == YamlNode::Kind::kList && !node.items.empty();
            const bool size = is_size(is_list ? node.items[0] : node);
            if (is_list && std::ranges::any_of(node.items, [&](const YamlNode& item) {
                  return is_size(item) != size;
                })) {
              draft.complaints.about(node,
                                     "expected two fractions or two sizes, found one of each");
              return std::nullopt;
            }
            const auto range = (size ? sizes : fractions).read(node, draft);
            if (!range) return std::nullopt;
            return SmoothnessDistribution{size ? Unit::kSize : Unit::kFraction, *range};
          },
          [fractions = range(fraction()), sizes = range(relief_size())](
              const SmoothnessDistribution& smoothness, const ConfigWriting& writing) {
            return (smoothness.unit == Unit::kSize ? sizes : fractions)
                .write(smoothness.range, writing);
          }};
}

Codec<SmoothnessDistribution> iterations() {
  const Codec<Range> counts = range(iteration_count());
  return {[=](const YamlNode& node, ConfigDraft& draft) -> std::optional<SmoothnessDistribution> {
            const auto range = counts.read(node, draft);
            if (!range) return std::nullopt;
            return SmoothnessDistribution{Unit::kIterations, *range};
          },
          [=](const SmoothnessDistribution& smoothness, const ConfigWriting& writing) {
            return counts.write(smoothness.range, writing);
          }};
}

std::string write_weights(const std::vector<WeightedHead>& weights, const ConfigWriting& writing) {
  std::vector<std::string> entries;
  for (const auto& [head, weight] : weights) {
    entries.push_back(entry(writing.head(head), format_number(weight)));
  }
  return flow_map(entries);
}

Codec<std::string> name() {
  return plain<std::string>(read_name, write_scalar);
}

Codec<std::string> text(const std::string& expected) {
  return plain<std::string>(
      [=](const YamlNode& node, Complaints& out) { return read_text(node, expected, out); },
      write_scalar);
}

Codec<Eigen::Index> head() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<Eigen::Index> {
            const auto name = read_name(node, draft.complaints);
            return name ? find_head(*name, node.place, node.path, draft) : std::nullopt;
          },
          [](Eigen::Index index, const ConfigWriting& writing) { return writing.head(index); }};
}

Codec<PlanePoint> point() {
  return plain<PlanePoint>(read_point, [](const PlanePoint& at) {
    return flow_list({format_number(at.x()), format_number(at.y())});
  });
}

Codec<std::filesystem::path> path(const std::string& expected) {
  return {[=](const YamlNode& node, ConfigDraft& draft) -> std::optional<std::filesystem::path> {
            const auto text = read_text(node, expected, draft.complaints);
            if (!text) return std::nullopt;
            return resolve(draft.folder, *text);
          },
          [](const std::filesystem::path& file, const ConfigWriting& writing) {
            const auto absolute = std::filesystem::absolute(file).lexically_normal();
            const auto relative = absolute.lexically_relative(writing.folder);
            return write_scalar(relative.empty() ? absolute.string() : relative.string());
          }};
}

}  // namespace crowdface
