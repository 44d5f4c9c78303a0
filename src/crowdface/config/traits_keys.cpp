// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/traits_keys.h"

#include <algorithm>

#include "crowdface/core/file.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

/// Largest accepted value of a measurement: in mm, in degrees, or as a ratio.
constexpr double kLargestTrait = 1000;

std::vector<std::string> measurement_names() {
  return texts_of(measurements(), [](const Measurement& of) { return of.name; });
}

/// Returns a complaint about a name that is not the name of a measurement.
std::string unknown_measurement(const std::string& name) {
  return concat("no measurement is called ", quoted(name), suggestion(name, measurement_names()),
                "; docs/traits.md lists all");
}

/// Reads a bound such as "38 mm", "104" (degrees or a ratio) or "70 %" (a quantile).
std::optional<TraitBound> read_bound(const YamlNode& node, const Measurement& measurement,
                                     ConfigDraft& draft) {
  const bool is_length = measurement.kind == Measurement::Kind::kDistance;
  const std::string expected =
      concat(is_length ? "a length with its unit, such as \"38 mm\","
             : measurement.kind == Measurement::Kind::kRatio ? "a ratio, such as 0.8,"
                                                             : "an angle in degrees, such as 104,",
             " or a quantile, such as \"70 %\"");
  if (node.kind != YamlNode::Kind::kScalar) return draft.complaints.add_mismatch(node, expected);
  std::string_view text = node.text;
  if (text.ends_with('%')) {
    text.remove_suffix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    const auto percent = parse_double(text);
    if (!percent || *percent < 0 || *percent > 100) {
      return draft.complaints.add_mismatch(node, "a quantile from 0 % to 100 %");
    }
    return TraitBound{*percent / 100, true};
  }
  const auto value = is_length ? parse_length_mm(text) : parse_double(text);
  if (!value || std::abs(*value) > kLargestTrait)
    return draft.complaints.add_mismatch(node, expected);
  return TraitBound{*value, false};
}

std::optional<TraitLimit> read_limit(const YamlEntry& entry, ConfigDraft& draft) {
  const auto trait = find_measurement(entry.key);
  if (!trait) {
    draft.complaints.add(entry.key_place, unknown_measurement(entry.key));
    return std::nullopt;
  }
  const Measurement& measurement = measurements()[*trait];
  const YamlNode& node = entry.value;
  TraitLimit limit{*trait};
  if (node.kind == YamlNode::Kind::kList && node.items.size() == 2) {
    limit.at_least = read_bound(node.items[0], measurement, draft);
    limit.at_most = read_bound(node.items[1], measurement, draft);
  } else if (node.kind == YamlNode::Kind::kMap) {
    const MapReader map(node, {"at_least", "at_most"}, draft.complaints);
    if (const YamlNode* least = map.find("at_least")) {
      limit.at_least = read_bound(*least, measurement, draft);
    }
    if (const YamlNode* most = map.find("at_most")) {
      limit.at_most = read_bound(*most, measurement, draft);
    }
  } else {
    return draft.complaints.add_mismatch(node, "[least, greatest] or {at_least: …, at_most: …}");
  }
  if (limit.at_least && limit.at_most &&
      limit.at_least->is_quantile == limit.at_most->is_quantile &&
      limit.at_least->value > limit.at_most->value) {
    return draft.complaints.add_mismatch(node, "a least value that is at most the greatest value");
  }
  return limit;
}

std::string bound_text(const TraitBound& end, const Measurement& measurement) {
  if (end.is_quantile) return concat(end.value * 100, " %");
  const bool is_length = measurement.kind == Measurement::Kind::kDistance;
  return is_length ? concat(end.value, " mm") : concat(end.value);
}

std::string limit_text(const TraitLimit& limit) {
  const Measurement& measurement = measurements()[limit.trait];
  std::vector<std::string> ends;
  if (limit.at_least)
    ends.push_back(yaml_entry("at_least", bound_text(*limit.at_least, measurement)));
  if (limit.at_most) ends.push_back(yaml_entry("at_most", bound_text(*limit.at_most, measurement)));
  return yaml_entry(measurement.name, yaml_flow_map(ends));
}

}  // namespace

Codec<TraitLimits> trait_limits() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            TraitLimits limits;
            draft.complaints.expect_map(node,
                                        "limits on measurements, {nose_width: {at_least: 38 mm}}");
            for (const YamlEntry& entry : node.entries) {
              if (auto limit = read_limit(entry, draft)) limits.push_back(*limit);
            }
            std::ranges::sort(limits, {}, &TraitLimit::trait);
            return std::optional(limits);
          },
          [](const TraitLimits& limits, const WriteContext&) {
            return limits.empty() ? "" : yaml_flow_map(texts_of(limits, limit_text));
          },
          "`{measurement: [least, greatest]}` or `{measurement: {at_least: …, at_most: …}}`"};
}

std::vector<TraitTarget> read_trait_table(const YamlNode& node, const std::filesystem::path& file,
                                          ConfigDraft& draft) {
  std::vector<TraitTarget> targets;
  const std::string text = read_file(file);
  std::size_t number = 0;
  for (std::string_view line : split_lines(text)) {
    ++number;
    if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);  // remove a byte order mark
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::vector<std::string> fields;
    for (std::string_view field : split(line, ',')) {
      while (!field.empty() && (is_blank(field.front()) || field.front() == '"')) {
        field.remove_prefix(1);
      }
      while (!field.empty() && (is_blank(field.back()) || field.back() == '"')) {
        field.remove_suffix(1);
      }
      fields.emplace_back(field);
    }
    if (fields.size() == 1 && fields[0].empty()) continue;
    if (number == 1 && fields[0] == "trait") continue;
    const auto complain = [&](const std::string& what) {
      draft.complaints.add_at(node, concat(file.string(), ":", number, ": ", what));
    };
    if (fields.size() != 3) {
      complain("expected a measurement, its mean and its standard deviation");
      continue;
    }
    const auto trait = find_measurement(fields[0]);
    const auto mean = parse_double(fields[1]), deviation = parse_double(fields[2]);
    if (!trait) {
      complain(unknown_measurement(fields[0]));
    } else if (!mean || std::abs(*mean) > kLargestTrait || !deviation || !(*deviation > 0) ||
               *deviation > kLargestTrait) {
      complain("expected numbers in mm, degrees or as a ratio, and a deviation above 0");
    } else if (std::ranges::find(targets, *trait, &TraitTarget::trait) != targets.end()) {
      complain(concat("expected one line for each measurement, found a second for ", fields[0]));
    } else {
      targets.push_back({*trait, *mean, *deviation});
    }
  }
  if (targets.empty() && draft.complaints.empty()) {
    draft.complaints.add_at(
        node,
        concat(
            file.string(),
            ": expected lines of a measurement, its mean and its standard deviation, found none"));
  }
  std::ranges::sort(targets, {}, &TraitTarget::trait);
  return targets;
}

}  // namespace crowdface
