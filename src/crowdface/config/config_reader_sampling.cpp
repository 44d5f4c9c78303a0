// SPDX-License-Identifier: Apache-2.0
// The section `sampling`.
#include <algorithm>
#include <map>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

constexpr double kMaxRadius = 1e6;
constexpr std::uint64_t kMostSources = 50;

using Words = std::vector<std::string>;

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A value that may differ from region to region.
struct PerRegion {
  std::optional<YamlNode> whole;  ///< for every region that has no value of its own
  std::vector<std::pair<std::size_t, const YamlNode*>> of_region;
};

/// Takes a value apart: one for all regions, or `{default: …, top: …}`, or both in one mapping.
/// \param parameters  the keys of a value that is itself a mapping. A region may bear the name of
/// one whose own values are never mappings: those then tell which is meant.
PerRegion split_by_region(const YamlNode& node, const Words& parameters, ConfigDraft& draft) {
  PerRegion split;
  if (node.kind != YamlNode::Kind::kMap) {
    split.whole = node;
    return split;
  }
  const Words& regions = draft.config.regions.names;
  YamlNode direct = node;
  direct.entries.clear();
  for (const YamlEntry& entry : node.entries) {
    const auto region = std::find(regions.begin(), regions.end(), entry.key);
    const bool is_region = region != regions.end() && (!contains(parameters, entry.key) ||
                                                       entry.value.kind == YamlNode::Kind::kMap);
    const bool empty = entry.value.kind == YamlNode::Kind::kNothing;
    if (empty && (is_region || entry.key == "default")) {
      draft.complaints.about(entry.value, "no value; write one, or leave the key out");
    } else if (is_region) {
      split.of_region.emplace_back(region - regions.begin(), &entry.value);
    } else if (entry.key == "default") {
      split.whole = entry.value;
    } else if (contains(parameters, entry.key)) {
      direct.entries.push_back(entry);
    } else if (draft.regions_known) {
      Words keys = parameters;
      keys.insert(keys.end(), regions.begin(), regions.end());
      keys.emplace_back("default");
      const std::string hint = suggestion(entry.key, keys);
      draft.complaints.add(entry.key_place,
                           concat(node.path, ": no region is called ", quoted(entry.key),
                                  hint.empty() ? concat("; expected one of ", join(keys)) : hint));
    }
  }
  if (!direct.entries.empty() && split.whole) {
    draft.complaints.about(node, "either default or the values directly, not both");
  } else if (!direct.entries.empty()) {
    split.whole = std::move(direct);
  } else if (node.entries.empty()) {
    draft.complaints.about(node, "expected a value, found an empty mapping");
  }
  return split;
}

/// Reads a value for each region into `member` of its distributions.
template <class Value, class Read>
void read_per_region(const YamlNode* node, const Words& parameters, Value RegionSampling::*member,
                     const Read& read, ConfigDraft& draft) {
  if (node == nullptr) return;
  auto& regions = draft.config.sampling.regions;
  const PerRegion split = split_by_region(*node, parameters, draft);
  if (split.whole) {
    const std::optional<Value> value = read(*split.whole, draft);
    for (RegionSampling& region : regions) {
      if (value) region.*member = *value;
    }
  }
  for (const auto& [region, own] : split.of_region) {
    const std::optional<Value> value = read(*own, draft);
    if (value) regions[region].*member = *value;
  }
}

const Words kPositionKeys = {"distribution", "pull", "face", "radius", "position"};

/// Which of the keys a distribution has no use for.
void refuse_keys(const YamlNode& node, const std::string& distribution, const Words& keys,
                 ConfigDraft& draft) {
  for (const std::string& key : keys) {
    const YamlEntry* entry = node.find(key);
    if (entry == nullptr) continue;
    draft.complaints.add(entry->key_place, concat(entry->value.path, ": the distribution ",
                                                  distribution, " has no ", key));
  }
}

void read_around(const MapReader& map, PositionDistribution& position, ConfigDraft& draft) {
  if (const YamlNode* face = map.find("face")) {
    const auto name = read_name(*face, draft.complaints);
    if (name && *name != "target") {
      position.head = find_head(*name, face->place, face->path, draft);
    }
  }
  if (const YamlNode* radius =
          map.require("radius", "how far from the face, in the plane's unit")) {
    position.radius = read_number(*radius, 0, kMaxRadius, draft.complaints).value_or(1);
    if (position.radius == 0) draft.complaints.expected(*radius, "a number above 0");
  }
}

std::optional<PositionDistribution> read_position(const YamlNode& node, ConfigDraft& draft) {
  const MapReader map(&node, kPositionKeys, draft.complaints);
  const YamlNode* kind = map.require("distribution", "anchored, uniform, around or fixed");
  if (kind == nullptr) return std::nullopt;
  using Kind = PositionDistribution::Kind;
  const auto chosen = read_choice(*kind, words_of<Kind>(), draft.complaints);
  if (!chosen) return std::nullopt;
  PositionDistribution position;
  position.kind = *chosen;
  switch (*chosen) {
    case Kind::kAnchored:
      refuse_keys(node, "anchored", {"face", "radius", "position"}, draft);
      if (const YamlNode* pull = map.find("pull")) {
        position.pull = read_number(*pull, 0, 1, draft.complaints).value_or(position.pull);
      }
      break;
    case Kind::kUniform:
      refuse_keys(node, "uniform", {"pull", "face", "radius", "position"}, draft);
      break;
    case Kind::kAround:
      refuse_keys(node, "around", {"pull", "position"}, draft);
      read_around(map, position, draft);
      break;
    case Kind::kFixed:
      refuse_keys(node, "fixed", {"pull", "face", "radius"}, draft);
      if (const YamlNode* at = map.require("position", "a point of the plane, [x, y]")) {
        position.at = read_point(*at, draft.complaints).value_or(PlanePoint::Zero());
      }
      break;
  }
  return position;
}

std::optional<SmoothnessDistribution> read_sampled_smoothness(const YamlNode& node,
                                                              ConfigDraft& draft) {
  if (node.kind != YamlNode::Kind::kMap) return read_smoothness(node, draft);
  const MapReader map(&node, {"iterations"}, draft.complaints);
  const YamlNode* iterations = map.require("iterations", "a whole number or [low, high]");
  return iterations == nullptr ? std::nullopt : read_iterations(*iterations, draft);
}

/// Heads by name or tag, each once, ascending; all of them for `all`.
std::vector<Eigen::Index> read_head_list(const YamlNode& node, ConfigDraft& draft) {
  std::vector<bool> chosen(draft.config.faces.names.size(), false);
  if (node.kind == YamlNode::Kind::kScalar && node.text == "all") {
    chosen.assign(chosen.size(), true);
  } else if (node.kind != YamlNode::Kind::kList || node.items.empty()) {
    draft.complaints.expected(node, "all or a list of heads and tags");
  } else {
    for (const YamlNode& item : node.items) {
      const auto name = read_name(item, draft.complaints);
      if (!name) continue;
      for (const Eigen::Index head : find_heads(*name, item.place, node.path, draft)) {
        chosen[static_cast<std::size_t>(head)] = true;
      }
    }
  }
  std::vector<Eigen::Index> heads;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i]) heads.push_back(static_cast<Eigen::Index>(i));
  }
  return heads;
}

/// `{name: weight}`: a head's own entry counts alone, the weights of several tags add up.
std::vector<WeightedHead> read_weighted_targets(const YamlNode& node, ConfigDraft& draft) {
  std::map<Eigen::Index, double> by_tag, by_name;
  for (const YamlEntry& entry : node.entries) {
    const auto heads = find_heads(entry.key, entry.key_place, node.path, draft);
    const auto weight = read_number(entry.value, 0, kLargestWeight, draft.complaints);
    if (weight == 0.0) {
      draft.complaints.expected(entry.value, "a weight above 0 (leave the head out for none)");
    }
    for (const Eigen::Index head : heads) {
      const bool named = draft.config.faces.names[static_cast<std::size_t>(head)] == entry.key;
      (named ? by_name : by_tag)[head] += weight.value_or(1);
    }
  }
  by_name.merge(by_tag);  // keeps what is there
  std::vector<WeightedHead> targets;
  for (const auto& [head, weight] : by_name) targets.push_back({head, weight});
  return targets;
}

std::vector<WeightedHead> read_targets(const YamlNode* node, ConfigDraft& draft) {
  YamlNode all;
  all.kind = YamlNode::Kind::kScalar;
  all.text = "all";
  if (node == nullptr) node = &all;
  if (node->kind == YamlNode::Kind::kMap && !node->entries.empty()) {
    return read_weighted_targets(*node, draft);
  }
  std::vector<WeightedHead> targets;
  for (const Eigen::Index head : read_head_list(*node, draft)) targets.push_back({head, 1});
  return targets;
}

std::vector<Eigen::Index> all_heads(const ConfigDraft& draft) {
  std::vector<Eigen::Index> heads(draft.config.faces.names.size());
  for (std::size_t i = 0; i < heads.size(); ++i) heads[i] = static_cast<Eigen::Index>(i);
  return heads;
}

std::vector<Eigen::Index> heads_tagged(std::string_view tag, const ConfigDraft& draft) {
  std::vector<Eigen::Index> heads;
  const auto& tags = draft.config.faces.tags;
  for (std::size_t h = 0; h < tags.size(); ++h) {
    if (std::find(tags[h].begin(), tags[h].end(), tag) != tags[h].end()) {
      heads.push_back(static_cast<Eigen::Index>(h));
    }
  }
  return heads;
}

}  // namespace

std::optional<Range> read_age(const YamlNode& node, ConfigDraft& draft) {
  const auto range = read_range(node, draft.complaints, [&](const YamlNode& value) {
    return read_number(value, -1, 1, draft.complaints);
  });
  if (!range || !draft.tags_known || !draft.heads_known) return range;
  const auto need = [&](bool needed, const std::vector<Eigen::Index>& heads, const char* tag) {
    if (needed && heads.empty()) {
      draft.complaints.about(node, concat("no head is tagged ", tag, " under faces.tags"));
    }
  };
  need(range->high > 0, draft.config.sampling.old_heads, "old");
  need(range->low < 0, draft.config.sampling.young_heads, "young");
  return range;
}

std::optional<SmoothnessDistribution> read_smoothness(const YamlNode& node, ConfigDraft& draft) {
  using Unit = SmoothnessDistribution::Unit;
  const auto is_size = [](const YamlNode& value) {
    return value.kind == YamlNode::Kind::kScalar && parse_length_mm(value.text).has_value();
  };
  const bool is_list = node.kind == YamlNode::Kind::kList && !node.items.empty();
  const bool size = is_size(is_list ? node.items[0] : node);
  if (is_list && std::any_of(node.items.begin(), node.items.end(),
                             [&](const YamlNode& item) { return is_size(item) != size; })) {
    draft.complaints.about(node, "expected two fractions or two sizes, found one of each");
    return std::nullopt;
  }
  const auto read_one = [&](const YamlNode& value) -> std::optional<double> {
    if (!size) {
      if (value.kind == YamlNode::Kind::kScalar && !parse_double(value.text)) {
        draft.complaints.expected(value, "a fraction from 0 to 1 or a size, such as \"8 mm\"");
        return std::nullopt;
      }
      return read_number(value, 0, 1, draft.complaints);
    }
    const auto length = read_length_mm(value, 1e9, draft.complaints);
    if (length && draft.largest_size_mm && *length > *draft.largest_size_mm) {
      draft.complaints.expected(
          value, concat("a size up to smoothing.max_size, ", *draft.largest_size_mm, " mm"));
      return std::nullopt;
    }
    return length;
  };
  const auto range = read_range(node, draft.complaints, read_one);
  if (!range) return std::nullopt;
  return SmoothnessDistribution{size ? Unit::kSize : Unit::kFraction, *range};
}

std::optional<SmoothnessDistribution> read_iterations(const YamlNode& node, ConfigDraft& draft) {
  const auto range =
      read_range(node, draft.complaints, [&](const YamlNode& value) -> std::optional<double> {
        const auto whole =
            read_whole(value, 0, draft.most_iterations.value_or(kMaxIterations), draft.complaints);
        return whole ? std::optional<double>(static_cast<double>(*whole)) : std::nullopt;
      });
  if (!range) return std::nullopt;
  return SmoothnessDistribution{SmoothnessDistribution::Unit::kIterations, *range};
}

std::optional<Range> read_extrapolation(const YamlNode& node, ConfigDraft& draft) {
  return read_range(node, draft.complaints, [&](const YamlNode& value) {
    return read_number(value, -kMaxExtrapolation, kMaxExtrapolation, draft.complaints);
  });
}

void read_sampling(const YamlNode* node, ConfigDraft& draft) {
  SamplingOptions& sampling = draft.config.sampling;
  sampling.regions.assign(draft.config.region_names().size(), RegionSampling{});
  const MapReader map(
      node, {"targets", "sources", "position", "smoothness", "extrapolation", "max_sources", "age"},
      draft.complaints);
  sampling.old_heads = heads_tagged("old", draft);
  sampling.young_heads = heads_tagged("young", draft);
  sampling.targets = read_targets(map.find("targets"), draft);
  const YamlNode* sources = map.find("sources");
  sampling.sources = sources == nullptr ? all_heads(draft) : read_head_list(*sources, draft);
  read_per_region(map.find("position"), kPositionKeys, &RegionSampling::position, read_position,
                  draft);
  read_per_region(map.find("smoothness"), {"iterations"}, &RegionSampling::smoothness,
                  read_sampled_smoothness, draft);
  read_per_region(map.find("extrapolation"), {}, &RegionSampling::extrapolation, read_extrapolation,
                  draft);
  const YamlNode* max_sources = map.find("max_sources");
  if (max_sources != nullptr &&
      !(max_sources->kind == YamlNode::Kind::kScalar && max_sources->text == "all")) {
    const auto most = read_whole(*max_sources, 1, kMostSources, draft.complaints);
    if (most) sampling.max_sources = static_cast<int>(*most);
  }
  if (const YamlNode* age = map.find("age")) {
    sampling.age = read_age(*age, draft).value_or(Range{0, 0});
  }
}

}  // namespace crowdface
