// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/codec.h"

#include <algorithm>
#include <map>
#include <set>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/units.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {
namespace {

using Unit = SmoothnessDistribution::Unit;

/// Makes a codec for values that do not depend on the rest of the config.
template <class Value, class Read, class Write>
Codec<Value> plain(const Read& read, const Write& write, const std::string& takes) {
  return {[=](const YamlNode& node, ConfigDraft& draft) { return read(node, draft.complaints); },
          [=](const Value& value, const WriteContext&) { return std::string(write(value)); },
          takes};
}

bool is_size(const YamlNode& node) {
  return node.kind == YamlNode::Kind::kScalar && parse_length_mm(node.text);
}

Codec<double> fraction() {
  Codec<double> codec = number(0, 1);
  codec.read = [=, number = codec.read](const YamlNode& node,
                                        ConfigDraft& draft) -> std::optional<double> {
    if (node.kind != YamlNode::Kind::kScalar || parse_double(node.text)) return number(node, draft);
    return draft.complaints.add_mismatch(node,
                                         "a fraction from 0 to 1 or a size, such as \"8 mm\"");
  };
  return codec;
}

/// Makes a codec for a smoothness that is given as a wavelength in mm (in the config: a size).
/// Smoothing halves the amplitude of relief that has this wavelength. The wavelength is at most
/// `smoothing.max_size`.
Codec<double> relief_size() {
  return restricted(length(1e9), [](double size, const YamlNode& node, ConfigDraft& draft) {
    const Config::Smoothing& smoothing = draft.config.smoothing;
    const bool bounded = draft.is_smoothing_known && !smoothing.max_iterations;
    if (!bounded || size <= smoothing.max_size_mm) return true;
    draft.complaints.add_mismatch(
        node, concat("a size up to smoothing.max_size, ", smoothing.max_size_mm, " mm"));
    return false;
  });
}

/// Makes a codec for a whole number that is stored as double. `write` avoids exponents, because
/// `read` refuses 1e+07.
Codec<double> iteration_count() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<double> {
            const std::uint64_t most =
                draft.config.smoothing.max_iterations.value_or(kMaxIterations);
            const auto count = read_whole_number(node, 0, most, draft.complaints);
            return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
          },
          [](double count, const auto&) { return concat(static_cast<std::uint64_t>(count)); },
          "whole number"};
}

/// Makes a codec for a smoothness in this unit, given as one value or as a range. `one` is the
/// codec for one value.
Codec<SmoothnessDistribution> smoothness_in_unit(Unit unit, const Codec<double>& one) {
  const Codec<Range> ranges = range(one);
  return {[=](const YamlNode& node, ConfigDraft& draft) {
            const auto read = ranges.read(node, draft);
            return read ? std::optional<SmoothnessDistribution>({unit, *read}) : std::nullopt;
          },
          [=](const SmoothnessDistribution& smoothness, const WriteContext& context) {
            return ranges.write(smoothness.range, context);
          },
          ranges.accepted_values};
}

/// Reads `{head or tag: weight}`. If a head has several of the tags, their weights add up. An entry
/// for the head itself replaces these weights.
std::vector<WeightedHead> read_weights(const YamlNode& node, ConfigDraft& draft) {
  std::map<Eigen::Index, double> by_tag, by_name;
  for (const YamlEntry& entry : node.entries) {
    const auto heads = find_heads(entry.key, entry.key_place, node.path, draft);
    const auto weight = read_number(entry.value, 0, kMaxSourceWeight, draft.complaints);
    if (weight == 0.0) {
      draft.complaints.add_mismatch(entry.value,
                                    "a weight above 0 (to exclude the head, remove its entry)");
    }
    for (const Eigen::Index head : heads) {
      const bool named = draft.config.faces.names[static_cast<std::size_t>(head)] == entry.key;
      (named ? by_name : by_tag)[head] += weight.value_or(1);
    }
  }
  by_name.merge(by_tag);  // weights by head name override weights by tag
  std::vector<WeightedHead> targets;
  for (const auto& [head, weight] : by_name) targets.push_back({head, weight});
  return targets;
}

std::vector<Eigen::Index> read_heads(const YamlNode& node, ConfigDraft& draft) {
  std::set<Eigen::Index> chosen;
  if (is_word(node, "all")) {
    for (std::size_t i = 0; i < draft.config.faces.names.size(); ++i) {
      chosen.insert(static_cast<Eigen::Index>(i));
    }
  } else if (node.items.empty()) {
    draft.complaints.add_mismatch(node, "all or a list of heads and tags");
  }
  for (const YamlNode& item : node.items) {
    const auto name = read_name(item, draft.complaints);
    if (!name) continue;
    const auto heads = find_heads(*name, item.place, node.path, draft);
    chosen.insert(heads.begin(), heads.end());
  }
  return {chosen.begin(), chosen.end()};
}

std::string write_heads(const std::vector<Eigen::Index>& heads, const WriteContext& context) {
  if (heads.size() == context.config.faces.names.size()) return "all";
  return yaml_flow_list(texts_of(heads, [&](Eigen::Index head) { return context.head(head); }));
}

std::vector<WeightedHead> read_weighted_heads(const YamlNode& node, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kMap && !node.entries.empty()) return read_weights(node, draft);
  std::vector<WeightedHead> heads;
  for (const Eigen::Index head : read_heads(node, draft)) heads.push_back({head, 1});
  return heads;
}

std::string write_weighted_heads(const std::vector<WeightedHead>& targets,
                                 const WriteContext& context) {
  const bool weighted =
      std::ranges::any_of(targets, [](const WeightedHead& t) { return t.weight != 1; });
  if (weighted) return write_weights(targets, context);
  std::vector<Eigen::Index> heads;
  for (const WeightedHead& target : targets) heads.push_back(target.head);
  return write_heads(heads, context);
}

std::optional<double> parse_years(std::string_view text) {
  constexpr std::string_view kUnit = "years";
  if (!text.ends_with(kUnit)) return std::nullopt;
  text.remove_suffix(kUnit.size());
  while (text.ends_with(' ')) text.remove_suffix(1);
  return parse_double(text);
}

bool is_age_in_years(const YamlNode& node) {
  return node.kind == YamlNode::Kind::kScalar && parse_years(node.text);
}

/// Makes a codec for an age from −1 (young) to 1 (old).
Codec<double> age_fraction() {
  Codec<double> codec = number(-1, 1);
  codec.read = [read = codec.read](const YamlNode& node,
                                   ConfigDraft& draft) -> std::optional<double> {
    const auto age = node.kind == YamlNode::Kind::kScalar ? parse_double(node.text) : std::nullopt;
    if (!age || *age < -1 || *age > 1) {
      return draft.complaints.add_mismatch(node,
                                           "a number from -1 to 1, or years, such as \"70 years\"");
    }
    const auto has = [&](const std::vector<Eigen::Index>& heads, const char* tag) {
      if (!heads.empty() || !draft.are_tags_known || !draft.are_heads_known) return true;
      draft.complaints.add_at(
          node, concat("no head has the tag ", tag, "; add the tag to heads under faces.tags"));
      return false;
    };
    const SamplingOptions& sampling = *draft.config.sampling;
    const bool is_there = *age == 0 || (*age > 0 ? has(sampling.heads_tagged_old, "old")
                                                 : has(sampling.heads_tagged_young, "young"));
    return is_there ? read(node, draft) : std::nullopt;
  };
  return codec;
}

/// Makes a codec for an age in years. Refuses an age that is outside the range of the heads' ages.
Codec<double> age_in_years() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<double> {
            const auto years =
                node.kind == YamlNode::Kind::kScalar ? parse_years(node.text) : std::nullopt;
            if (!years) {
              return draft.complaints.add_mismatch(
                  node, "two numbers from -1 to 1 or two ages in years, [20 years, 70 years]");
            }
            if (!draft.are_tags_known || !draft.are_heads_known) return years;
            const Config::Faces& faces = draft.config.faces;
            const auto unknown = std::ranges::find(faces.ages_years, std::optional<double>());
            if (unknown != faces.ages_years.end()) {
              const auto head = static_cast<std::size_t>(unknown - faces.ages_years.begin());
              draft.complaints.add_at(node, concat("the age of the head ", faces.names[head],
                                                   " is unknown; write faces.ages for all heads"));
              return std::nullopt;
            }
            const auto [youngest, oldest] = std::ranges::minmax(faces.ages_years);
            if (*years >= *youngest && *years <= *oldest) return years;
            const bool is_younger = *years < *youngest;
            draft.complaints.add_at(
                node, concat("expected an age from ", *youngest, " to ", *oldest,
                             " years, the ages of the heads, found ", quoted(node.text), "; ",
                             is_younger ? "younger" : "older", " faces need ",
                             is_younger ? "younger" : "older", " heads"));
            return std::nullopt;
          },
          [](double years, const WriteContext&) { return concat(format_number(years), " years"); },
          "years"};
}

}  // namespace

std::string WriteContext::head(Eigen::Index index) const {
  return write_scalar(config.faces.names[static_cast<std::size_t>(index)]);
}

std::string remove_article(std::string_view expected) {
  for (const std::string_view article : {"a ", "an "}) {
    if (expected.starts_with(article)) expected.remove_prefix(article.size());
  }
  return std::string(expected);
}

Codec<double> number(double low, double high) {
  return plain<double>(
      [=](const YamlNode& node, Complaints& out) { return read_number(node, low, high, out); },
      format_number, concat("number, ", plain_number(low), " … ", plain_number(high)));
}

Codec<std::uint64_t> whole_number(std::uint64_t low, std::uint64_t high) {
  return plain<std::uint64_t>(
      [=](const YamlNode& node, Complaints& out) {
        return read_whole_number(node, low, high, out);
      },
      [](std::uint64_t value) { return concat(value); },
      concat("whole number, ", low, " … ", high));
}

Codec<LengthUnit> length_unit() {
  return plain<LengthUnit>(
      [](const YamlNode& node, Complaints& out) -> std::optional<LengthUnit> {
        const bool is_scalar = node.kind == YamlNode::Kind::kScalar;
        const auto unit = is_scalar ? parse_length_unit(node.text) : std::nullopt;
        if (!unit) out.add_mismatch(node, std::string(kUnitChoices));
        return unit;
      },
      [](LengthUnit unit) { return name_of(unit); }, "`mm`, `cm`, `m`, `in`, `ft`, or a length");
}

Codec<double> length(double high_mm) {
  return plain<double>(
      [=](const YamlNode& node, Complaints& out) -> std::optional<double> {
        const bool is_scalar = node.kind == YamlNode::Kind::kScalar;
        if (is_scalar && parse_double(node.text)) {
          out.add_at(node, concat("expected a length with its unit, such as \"8 mm\", found ",
                                  quoted(node.text), "; mm, cm, m or in?"));
          return std::nullopt;
        }
        const auto value = is_scalar ? parse_length_mm(node.text) : std::nullopt;
        if (!value || *value < 0 || *value > high_mm) {
          return out.add_mismatch(node, concat("a length from 0 mm to ", plain_number(high_mm),
                                               " mm with its unit, such as ", "\"8 mm\""));
        }
        return *value == 0 ? 0.0 : *value;  // turn -0 into 0
      },
      [](double value_mm) { return concat(value_mm, " mm"); },
      concat("length, up to ", plain_number(high_mm), " mm"));
}

Codec<double> positive_length(double high_mm) {
  return nonzero(length(high_mm),
                 concat("a length above 0 mm, up to ", plain_number(high_mm), " mm"));
}

Codec<double> nonzero(const Codec<double>& codec, const std::string& expected) {
  Codec<double> above =
      restricted(codec, [=](double value, const YamlNode& node, ConfigDraft& draft) {
        if (value == 0) draft.complaints.add_mismatch(node, expected);
        return value != 0;
      });
  above.accepted_values = remove_article(expected);
  return above;
}

Codec<Range> range(const Codec<double>& one) {
  return {[=](const YamlNode& node, ConfigDraft& draft) -> std::optional<Range> {
            if (node.kind != YamlNode::Kind::kList) {
              const auto value = one.read(node, draft);
              return value ? std::optional<Range>({*value, *value}) : std::nullopt;
            }
            if (node.items.size() != 2) {
              return draft.complaints.add_mismatch(node, "one value or a list of two, [low, high]");
            }
            const auto low = one.read(node.items[0], draft);
            const auto high = one.read(node.items[1], draft);
            if (!low || !high) return std::nullopt;
            if (*low <= *high) return Range{*low, *high};
            draft.complaints.add_at(node,
                                    concat("expected [low, high] with low at most high, found [",
                                           node.items[0].text, ", ", node.items[1].text, ']'));
            return std::nullopt;
          },
          [=](const Range& range, const WriteContext& context) {
            const std::string low = one.write(range.low, context);
            return range.low == range.high ? low
                                           : yaml_flow_list({low, one.write(range.high, context)});
          },
          concat(one.accepted_values, ", or a range")};
}

Codec<AgeRange> age() {
  const auto fractions = range(age_fraction()), years = range(age_in_years());
  return {[=](const YamlNode& node, ConfigDraft& draft) -> std::optional<AgeRange> {
            const bool is_list = node.kind == YamlNode::Kind::kList && !node.items.empty();
            const bool in_years = is_age_in_years(is_list ? node.items[0] : node);
            const auto ages = (in_years ? years : fractions).read(node, draft);
            if (!ages) return std::nullopt;
            return AgeRange{*ages, in_years ? AgeUnit::kYears : AgeUnit::kFraction};
          },
          [=](const AgeRange& ages, const WriteContext& context) {
            return (ages.unit == AgeUnit::kYears ? years : fractions).write(ages.range, context);
          },
          "number, -1 … 1, or `70 years`, or a range"};
}

Codec<Range> asymmetry() {
  return range(number(0, kMaxAsymmetry));
}

Codec<Range> extrapolation() {
  return range(number(-kMaxExtrapolation, kMaxExtrapolation));
}

Codec<SmoothnessDistribution> smoothness() {
  const auto fractions = smoothness_in_unit(Unit::kFraction, fraction());
  const auto sizes = smoothness_in_unit(Unit::kSize, relief_size());
  return {[=](const YamlNode& node, ConfigDraft& draft) -> std::optional<SmoothnessDistribution> {
            const bool is_list = node.kind == YamlNode::Kind::kList && !node.items.empty();
            const bool size = is_size(is_list ? node.items[0] : node);
            if (is_list && std::ranges::any_of(node.items, [&](const YamlNode& item) {
                  return is_size(item) != size;
                })) {
              draft.complaints.add_at(node,
                                      "expected two fractions or two sizes, found one of each");
              return std::nullopt;
            }
            return (size ? sizes : fractions).read(node, draft);
          },
          [=](const SmoothnessDistribution& smoothness, const WriteContext& context) {
            return (smoothness.unit == Unit::kSize ? sizes : fractions).write(smoothness, context);
          },
          "fraction, 0 … 1, or a size, or a range of either"};
}

Codec<SmoothnessDistribution> smoothness_in_iterations() {
  return smoothness_in_unit(Unit::kIterations, iteration_count());
}

std::string write_weights(const std::vector<WeightedHead>& weights, const WriteContext& context) {
  return yaml_flow_map(texts_of(weights, [&](const WeightedHead& one) {
    return yaml_entry(context.head(one.head), format_number(one.weight));
  }));
}

Codec<std::string> name() {
  return plain<std::string>(read_name, write_scalar, "name");
}

Codec<std::string> text(const std::string& expected) {
  return plain<std::string>(
      [=](const YamlNode& node, Complaints& out) { return read_text(node, expected, out); },
      write_scalar, remove_article(expected));
}

Codec<Eigen::Index> head() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<Eigen::Index> {
            const auto name = read_name(node, draft.complaints);
            return name ? find_head(*name, node.place, node.path, draft) : std::nullopt;
          },
          [](Eigen::Index index, const WriteContext& context) { return context.head(index); },
          "head"};
}

Codec<std::vector<Eigen::Index>> head_list() {
  return {read_heads, write_heads, "`all`, or a list of heads and tags"};
}

Codec<std::vector<WeightedHead>> weighted_heads() {
  return {read_weighted_heads, write_weighted_heads,
          "`all`, a list of heads and tags, or `{head or tag: weight}`"};
}

Codec<PlanePoint> plane_point() {
  return {[coordinate = number(-kMaxPlaneCoordinate, kMaxPlaneCoordinate)](
              const YamlNode& node, ConfigDraft& draft) -> std::optional<PlanePoint> {
            if (node.kind != YamlNode::Kind::kList || node.items.size() != 2) {
              return draft.complaints.add_mismatch(node, "a list of two numbers, [x, y]");
            }
            const auto x = coordinate.read(node.items[0], draft);
            const auto y = coordinate.read(node.items[1], draft);
            return x && y ? std::optional(PlanePoint(*x, *y)) : std::nullopt;
          },
          [](const PlanePoint& at, const WriteContext&) {
            return yaml_flow_list({format_number(at.x()), format_number(at.y())});
          },
          "`[x, y]`"};
}

Codec<std::map<std::string, double>> hair_colours() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            std::map<std::string, double> shares;
            std::vector<std::string> names;
            std::vector<double> values;
            for (const NamedHairColour& known : named_hair_colours())
              names.emplace_back(known.name);
            draft.complaints.expect_map(node, "a mapping from hair colours to shares, {red: 0.3}");
            for (const YamlEntry& entry : node.entries) {
              const auto share = number(0, 1).read(entry.value, draft);
              if (!contains(names, entry.key)) {
                draft.complaints.add_at(
                    entry.value, concat("no hair colour is called ", quoted(entry.key),
                                        suggestion(entry.key, names), "; expected ", join(names)));
              } else if (share) {
                shares[entry.key] = *share;
                values.push_back(*share);
              }
            }
            const auto factor = factor_of_rounded_shares(values);
            if (!factor) {
              draft.complaints.add_at(node.entries.back().value,
                                      "the shares add up to more than 1");
            }
            for (auto& share : shares) share.second *= factor.value_or(1);
            return std::optional(shares);
          },
          [](const std::map<std::string, double>& shares, const WriteContext&) {
            return yaml_flow_map(texts_of(shares, [](const auto& share) {
              return yaml_entry(share.first, format_number(share.second));
            }));
          },
          "`{hair colour: share}`, shares 0 … 1"};
}

Codec<std::filesystem::path> path(const std::string& expected) {
  return {[=](const YamlNode& node, ConfigDraft& draft) -> std::optional<std::filesystem::path> {
            const auto text = read_text(node, expected, draft.complaints);
            if (!text) return std::nullopt;
            return resolve(draft.folder, *text);
          },
          [](const std::filesystem::path& file, const WriteContext& context) {
            if (file.empty()) return std::string();
            const auto absolute = std::filesystem::absolute(file).lexically_normal();
            const auto relative = absolute.lexically_relative(context.folder);
            return write_scalar(relative.empty() ? absolute.string() : relative.string());
          },
          remove_article(expected)};
}

Codec<std::filesystem::path> obj_file() {
  return restricted(path("an OBJ file"), [](const std::filesystem::path& file, const YamlNode& node,
                                            ConfigDraft& draft) {
    if (mesh_format_of(file) == MeshFormat::kObj) return expect_file(node, file, draft);
    draft.complaints.add_mismatch(node, "a file whose name ends in .obj");
    return false;
  });
}

}  // namespace crowdface
