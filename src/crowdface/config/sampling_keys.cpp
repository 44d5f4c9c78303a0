// SPDX-License-Identifier: Apache-2.0
// The config section `sampling`.
#include <algorithm>
#include <set>

#include "crowdface/config/config_keys.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr double kMaxRadius = 1e6;
constexpr std::uint64_t kMaxSources = 50;

using Names = std::vector<std::string>;
using Kind = PositionDistribution::Kind;

/// The value of one config key, if the value may differ between regions.
struct PerRegion {
  std::optional<YamlNode> whole;  ///< value of all regions that `of_region` does not contain
  /// for each region that has its own value: index of the region, and the value
  std::vector<std::pair<std::size_t, const YamlNode*>> of_region;
};

/// Splits the value of a key by region. The value has one of these forms:
///
/// - `V`: the value V of all regions;
/// - `{default: V, top: W}`: the value W of the region `top`, and the value V of all other regions;
/// - `{distribution: uniform, top: W}`: the value W of the region `top`, and the mapping V =
///   `{distribution: uniform}` as the value of all other regions.
///
/// If a region and a parameter have the same name, an entry with this name belongs to the region if
/// the entry's value is a mapping, and otherwise to the parameter.
///
/// \param parameters  the keys that V has if V is a mapping.
PerRegion split_by_region(const YamlNode& node, const Names& parameters, ConfigDraft& draft) {
  PerRegion split;
  if (node.kind != YamlNode::Kind::kMap) {
    split.whole = node;
    return split;
  }
  // `direct` collects the parameters that stand directly in the mapping, not below `default`.
  const Names& regions = draft.config.regions.names;
  YamlNode direct = node;
  direct.entries.clear();
  for (const YamlEntry& entry : node.entries) {
    const auto region = std::ranges::find(regions, entry.key);
    const bool is_region = region != regions.end() && (!contains(parameters, entry.key) ||
                                                       entry.value.kind == YamlNode::Kind::kMap);
    const bool empty = entry.value.kind == YamlNode::Kind::kNothing;
    if (empty && (is_region || entry.key == "default")) {
      draft.complaints.add_at(entry.value, "no value; write one, or leave the key out");
    } else if (is_region) {
      split.of_region.emplace_back(region - regions.begin(), &entry.value);
    } else if (entry.key == "default") {
      split.whole = entry.value;
    } else if (contains(parameters, entry.key)) {
      direct.entries.push_back(entry);
    } else if (draft.are_regions_known) {
      Names keys = parameters;
      keys.insert(keys.end(), regions.begin(), regions.end());
      keys.emplace_back("default");
      const std::string hint = suggestion(entry.key, keys);
      draft.complaints.add(entry.key_place,
                           concat(node.path, ": no region is called ", quoted(entry.key),
                                  hint.empty() ? concat("; expected one of ", join(keys)) : hint));
    }
  }
  if (!direct.entries.empty() && split.whole) {
    draft.complaints.add_at(node, "expected either default or values without default, found both");
  } else if (!direct.entries.empty()) {
    split.whole = std::move(direct);
  } else if (node.entries.empty()) {
    draft.complaints.add_at(node, "expected a value, found an empty mapping");
  }
  return split;
}

/// Makes a key whose value may differ between the regions of a section. Empty optionals are not
/// written.
///
/// \param parameters  see split_by_region.
template <class Section, class Region, class Member, class Value>
Key<Section> per_region_key(std::string_view name, Member Region::*member,
                            const Codec<Value>& codec, const Names& parameters = {}) {
  return {
      name,
      [=, own = key(name, member, codec)](const YamlNode& node, Section& section,
                                          ConfigDraft& draft) {
        const PerRegion split = split_by_region(node, parameters, draft);
        const auto whole = split.whole ? codec.read(*split.whole, draft) : std::nullopt;
        for (Region& region : section.regions) {
          if (whole) region.*member = *whole;
        }
        for (const auto& [region, value] : split.of_region) {
          own.read(*value, section.regions[region], draft);
        }
      },
      [own = key(name, member, codec)](const Section& section, const WriteContext& context) {
        const Names& names = context.config.regions.names;
        std::vector<std::string> entries;
        for (std::size_t i = 0; i < section.regions.size(); ++i) {
          const std::string value = own.write(section.regions[i], context);
          if (value.empty()) continue;
          entries.push_back(yaml_entry(names.empty() ? "default" : write_scalar(names[i]), value));
        }
        return entries.empty() ? "" : yaml_block_map(entries);
      },
      {},
      {},
      codec.accepted_values};
}

/// The key `face` of a position: the name of the head around which positions are sampled, or
/// `target` for the face's target.
const Key<PositionDistribution> kHeadOfPositionKey = {
    "face",
    [](const YamlNode& node, PositionDistribution& position, ConfigDraft& draft) {
      if (!is_word(node, "target")) position.head = head().read(node, draft);
    },
    [](const PositionDistribution& position, const WriteContext& context) {
      return position.head ? context.head(*position.head) : "target";
    }};

const Keys<PositionDistribution>& position_keys() {
  using Position = PositionDistribution;
  static const Keys<Position> keys = {
      word_key("distribution", &Position::kind, "anchored, uniform, around or fixed"),
      key("pull", &Position::pull, number(0, 1)), kHeadOfPositionKey,
      key("radius", &Position::radius, nonzero(number(0, kMaxRadius), "a number above 0")),
      key("position", &Position::at, plane_point())};
  return keys;
}

/// The keys that the config may use to describe the distribution of a position on the weight plane,
/// if the distribution is of the kind `kind`.
struct KindKeys {
  Kind kind;
  Names keys;
  /// If the last of `keys` is required: advice for the message when that key is missing. Otherwise
  /// empty.
  std::string_view advice_if_last_is_missing = {};
};
const std::vector<KindKeys> kKindKeys = {
    {Kind::kAnchored, {"distribution", "pull"}},
    {Kind::kUniform, {"distribution"}},
    {Kind::kAround,
     {"distribution", "face", "radius"},
     "write the distance from the face, in units of the plane"},
    {Kind::kFixed, {"distribution", "position"}, "a point of the plane, [x, y]"}};

const KindKeys& keys_of(Kind kind) {
  return *std::ranges::find(kKindKeys, kind, &KindKeys::kind);
}

std::optional<PositionDistribution> read_position(const YamlNode& node, ConfigDraft& draft) {
  const std::size_t complaints_before = draft.complaints.size();
  PositionDistribution position;
  read_keys(node, position_keys(), position, draft);
  if (draft.complaints.size() != complaints_before) return std::nullopt;
  const KindKeys& own = keys_of(position.kind);
  for (const YamlEntry& entry : node.entries) {
    if (contains(own.keys, entry.key)) continue;
    draft.complaints.add(entry.key_place,
                         concat(entry.value.path, ": the distribution ", word_of(position.kind),
                                " does not use this key; remove it"));
  }
  if (!own.advice_if_last_is_missing.empty() && node.find(own.keys.back()) == nullptr) {
    draft.complaints.add(node.place, concat(node.path, '.', own.keys.back(), ": missing; ",
                                            own.advice_if_last_is_missing));
  }
  return position;
}

std::string write_position(const PositionDistribution& position, const WriteContext& context) {
  Keys<PositionDistribution> keys = position_keys();
  std::erase_if(keys,
                [&](const auto& key) { return !contains(keys_of(position.kind).keys, key.name); });
  return yaml_flow_map(write_keys(keys, position, context));
}

/// Codec for a smoothness as in smoothness(), or as `{iterations: …}`.
Codec<SmoothnessDistribution> sampled_smoothness() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<SmoothnessDistribution> {
            if (node.kind != YamlNode::Kind::kMap) return smoothness().read(node, draft);
            const MapReader map(node, {"iterations"}, draft.complaints);
            const YamlNode* count = map.require("iterations", "a whole number or [low, high]");
            return count == nullptr ? std::nullopt : smoothness_in_iterations().read(*count, draft);
          },
          [](const SmoothnessDistribution& value, const WriteContext& context) {
            return value.unit == SmoothnessDistribution::Unit::kIterations
                       ? yaml_flow_map({yaml_entry(
                             "iterations", smoothness_in_iterations().write(value, context))})
                       : smoothness().write(value, context);
          },
          concat(smoothness().accepted_values, ", or `{iterations: …}`")};
}

constexpr std::size_t kMaxBands = 4;

const Keys<BandSampling>& band_keys() {
  using Band = BandSampling;
  static const Keys<Band> keys = {
      per_region_key<Band>("smoothness", &Band::Region::smoothness, sampled_smoothness(),
                           {"iterations"}),
      per_region_key<Band>("position", &Band::Region::position,
                           Codec<PositionDistribution>{read_position, write_position,
                                                       "mapping, see [below](#where-position)"},
                           names_of(position_keys())),
      per_region_key<Band>("extrapolation", &Band::Region::extrapolation, extrapolation()),
      key("sources", &Band::sources, head_list()), key("ageing", &Band::ageing, number(0, 1))};
  return keys;
}

/// Reads a band. The value is a mapping, or only the band's smoothness (the size at which the band
/// begins).
void read_band(const YamlNode& node, BandSampling& band, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kMap) {
    read_keys(node, band_keys(), band, draft);
  } else {
    band_keys().front().read(node, band, draft);
  }
}

void check_band_name(const YamlEntry& entry, const SamplingOptions& sampling, ConfigDraft& draft) {
  static const std::set<std::string> reserved = {"all", "default", "none"};
  const Names regions = draft.config.region_names();
  std::string why;
  if (!is_valid_name(entry.key)) {
    why = "is not a valid name; expected letters (a-z), digits, '_', '-' or '.'";
  } else if (reserved.contains(entry.key) || contains(regions, entry.key)) {
    why = "is a reserved word or the name of a region; rename the band";
  } else if (sampling.bands.size() == kMaxBands) {
    why = concat("is one band too many; expected at most ", kMaxBands);
  }
  if (!why.empty()) draft.complaints.add(entry.key_place, concat(quoted(entry.key), ' ', why));
}

/// Reads the bands of the crowd, from coarse to fine. In a group, reads changes to the values of
/// these bands.
void read_bands(const YamlNode& node, SamplingOptions& sampling, ConfigDraft& draft) {
  draft.complaints.expect_map(
      node, "a mapping from bands to sizes, coarse to fine, {build: 240 mm, skin: 8 mm}");
  const bool of_crowd = &sampling == &*draft.config.sampling;
  for (const YamlEntry& entry : node.entries) {
    auto band = std::ranges::find(sampling.bands, entry.key, &BandSampling::name);
    if (band == sampling.bands.end()) {
      if (!of_crowd) {
        draft.complaints.add(
            entry.key_place,
            concat("no band of sampling.bands is called ", quoted(entry.key),
                   suggestion_or_choices(
                       entry.key, texts_of(sampling.bands,
                                           [](const BandSampling& one) { return one.name; }))));
        continue;
      }
      check_band_name(entry, sampling, draft);
      const bool first = sampling.bands.empty();
      // if there are several bands, ageing does not change the first band (the coarsest) by default
      const bool is_coarsest = first && node.entries.size() > 1;
      band = sampling.bands.insert(band, {entry.key, {}, {}, is_coarsest ? 0.0 : 1.0});
      band->regions.resize(sampling.regions.size());
      const YamlNode& value = entry.value;
      if (!first && value.kind == YamlNode::Kind::kMap && value.find("smoothness") == nullptr) {
        draft.complaints.add_at(
            value, "smoothness: missing; write the size at which the band begins, such as 8 mm");
      }
    }
    read_band(entry.value, *band, draft);
  }
}

std::string write_bands(const SamplingOptions& sampling, const WriteContext& context) {
  if (sampling.bands.empty()) return "";
  return yaml_block_map(texts_of(sampling.bands, [&](const BandSampling& band) {
    return yaml_entry(write_scalar(band.name),
                      yaml_block_map(write_keys(band_keys(), band, context)));
  }));
}

bool is_mirrored(const SamplingOptions& sampling, const WriteContext& context) {
  return may_mirror(sampling) || may_mirror(*context.config.sampling);
}

}  // namespace

const Keys<SamplingOptions>& sampling_keys() {
  using Sampling = SamplingOptions;
  static const Keys<Sampling> keys = {
      key("targets", &Sampling::targets, weighted_heads()),
      key("sources", &Sampling::sources, head_list()),
      per_region_key<Sampling>("position", &RegionSampling::position,
                               Codec<PositionDistribution>{read_position, write_position,
                                                           "mapping, see [below](#where-position)"},
                               names_of(position_keys())),
      per_region_key<Sampling>("smoothness", &RegionSampling::smoothness, sampled_smoothness(),
                               {"iterations"})
          .with_starter_lines(
              {"[0.15, 0.7]", "",
               "How much of the target's relief is replaced by that of the sources: 0 "
               "nothing, 1 all of it\nup to 240 mm. Or a size: [4 mm, 30 mm]."}),
      per_region_key<Sampling>("extrapolation", &RegionSampling::extrapolation, extrapolation())
          .with_starter_lines(
              {"[0.9, 1.2]", "", "Above 1 features are stronger than scanned, below 1 weaker."}),
      Key<Sampling>{"max_sources",
                    [](const YamlNode& node, Sampling& sampling, ConfigDraft& draft) {
                      sampling.max_sources.reset();
                      if (is_word(node, "all")) return;
                      const auto most = whole_number(1, kMaxSources).read(node, draft);
                      if (most) sampling.max_sources = static_cast<int>(*most);
                    },
                    [](const Sampling& sampling, const WriteContext&) {
                      return sampling.max_sources ? concat(*sampling.max_sources) : "all";
                    }}
          .with_accepted_values(concat("`all`, or ", whole_number(1, kMaxSources).accepted_values))
          .with_starter_lines(
              {"3", "", "How many heads lend their features to each region of a face."}),
      Key<Sampling>{"bands", read_bands, write_bands}
          .with_accepted_values("mapping from names to the keys of a band")
          .with_nested_keys(band_keys()),
      key("age", &Sampling::age, age()),
      key("asymmetry", &Sampling::asymmetry, asymmetry()).written_if(is_mirrored),
      word_key("mirror", &Sampling::mirror).written_if(is_mirrored)};
  return keys;
}

}  // namespace crowdface
