// SPDX-License-Identifier: Apache-2.0
// The config sections `distance`, `diversity` and `believability`: how the distances between faces
// are measured, and the limits that faces must meet.
#include <algorithm>
#include <functional>
#include <iterator>

#include "crowdface/cast/diversity.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/contains.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

constexpr double kShareRounding = 1e-9;
// a starter config has `meshes: judge` only if each head has at most this number of vertices
constexpr Eigen::Index kMaxJudged = 200'000;

/// Reads the path of one image or of a set of UDIM tiles (several images that form one texture).
void read_mask(const YamlNode& node, Config::Distance& distance, ConfigDraft& draft) {
  const auto mask = path("an image file").read(node, draft);
  if (!mask) return;
  distance.mask = mask->string();
  if (distance.mask->find(kTileWord) == std::string::npos) expect_file(node, *mask, draft);
}

std::string write_mask(const Config::Distance& distance, const WriteContext& context) {
  return distance.mask ? path("").write(*distance.mask, context) : "";
}

/// An entry of `diversity.quotas`, a key that no longer exists.
struct Quota {
  std::string name;  ///< name of a head, or a tag of heads
  double share = 0;
  std::vector<Eigen::Index> heads;
  /// band of detail that the quota applies to; none: the quota applies to the target
  std::optional<std::size_t> band;
};

/// Returns the heads of all quotas that apply to a band. If no band is given, returns the heads of
/// all quotas that apply to the targets of faces (the heads that faces are built on).
std::vector<Eigen::Index> heads_of(const std::vector<Quota>& quotas,
                                   std::optional<std::size_t> band) {
  std::vector<Eigen::Index> heads;
  for (const Quota& quota : quotas) {
    if (quota.band == band) heads.insert(heads.end(), quota.heads.begin(), quota.heads.end());
  }
  return heads;
}

/// Returns some of `items`: those whose head is in `listed` if `keep_listed` is true, otherwise
/// those whose head is not in `listed`.
///
/// \param head  head(item) returns the index of an item's head.
template <class Items, class Head>
Items select_by_head(Items items, const std::vector<Eigen::Index>& listed, bool keep_listed,
                     const Head& head) {
  std::erase_if(items,
                [&](const auto& item) { return contains(listed, head(item)) != keep_listed; });
  return items;
}

/// Returns an entry of the config key `groups` that has the effect of a quota of the obsolete key
/// `diversity.quotas`. If `quota` is null, returns an entry for the faces that no quota covers.
std::string group_text(const std::vector<Quota>& quotas, const Quota* quota,
                       const WriteContext& context) {
  const SamplingOptions& sampling = *context.config.sampling;
  std::vector<std::string> entries = {
      yaml_entry("name", quota ? write_scalar(quota->name) : "others")};
  if (quota) entries.push_back(yaml_entry("share", format_number(quota->share)));
  const auto part = [&](auto heads, std::optional<std::size_t> band, const auto& head) {
    const bool own = quota && quota->band == band;
    return select_by_head(std::move(heads), own ? quota->heads : heads_of(quotas, band), own, head);
  };
  if (!heads_of(quotas, std::nullopt).empty()) {
    const auto targets = part(sampling.targets, std::nullopt, std::mem_fn(&WeightedHead::head));
    entries.push_back(yaml_entry("targets", weighted_heads().write(targets, context)));
  }
  std::vector<std::string> bands;
  for (std::size_t b = 0; b < sampling.bands.size(); ++b) {
    if (heads_of(quotas, b).empty()) continue;
    const auto sources = part(sources_of(sampling, b), b, std::identity());
    bands.push_back(
        yaml_entry(write_scalar(sampling.bands[b].name),
                   yaml_flow_map({yaml_entry("sources", head_list().write(sources, context))})));
  }
  if (!bands.empty()) entries.push_back(yaml_entry("bands", yaml_flow_map(bands)));
  return yaml_flow_map(entries);
}

std::optional<Quota> read_quota(const YamlNode& node, const YamlEntry& entry, ConfigDraft& draft) {
  const bool is_map = entry.value.kind == YamlNode::Kind::kMap;
  const YamlEntry* share = is_map ? entry.value.find("share") : &entry;
  const YamlEntry* band = is_map ? entry.value.find("band") : nullptr;
  const auto value = share ? number(0, 1).read(share->value, draft) : std::nullopt;
  Quota quota{entry.key, value.value_or(0), {}, {}};
  quota.heads = find_heads(entry.key, entry.key_place, node.path, draft);
  const auto& bands = draft.config.sampling->bands;
  if (band) {
    quota.band = static_cast<std::size_t>(
        std::ranges::find(bands, band->value.text, &BandSampling::name) - bands.begin());
  }
  return value && !quota.heads.empty() && quota.band != bands.size() ? std::optional(quota)
                                                                     : std::nullopt;
}

/// Refuses quotas with a message that shows the groups to use instead. Accepts an empty mapping,
/// because the configs of older crowds contain one.
void refuse_quotas(const YamlNode& node, DiversityOptions& /*diversity*/, ConfigDraft& draft) {
  if (node.entries.empty()) return;
  std::vector<Quota> quotas;
  double total = 0;
  for (const YamlEntry& entry : node.entries) {
    const auto quota = read_quota(node, entry, draft);
    if (!quota) continue;
    quotas.push_back(*quota);
    total += quota->share;
  }
  std::string message = "groups have replaced quotas";
  if (quotas.size() == node.entries.size()) {
    const WriteContext context{draft.config, draft.folder};
    message += "; remove quotas and add to the config:\ngroups:";
    for (const Quota& quota : quotas) {
      message += concat("\n  - ", group_text(quotas, &quota, context));
    }
    if (total < 1 - kShareRounding) {
      message += concat("\n  - ", group_text(quotas, nullptr, context));
    }
  }
  draft.complaints.add_at(node, message);
}

const Keys<BelievabilityOptions>& believability_keys() {
  using Believability = BelievabilityOptions;
  static const Keys<Believability> keys = {
      key("max_deviation", &Believability::max_deviation, number(0, 1000)),
      key("max_stretch", &Believability::max_stretch, number(1, 1000)),
      key("max_flipped", &Believability::max_flipped, number(0, 1)),
      key("max_intersecting", &Believability::max_intersecting, number(0, 1)),
      key("max_gap", &Believability::max_gap_mm, length(kMaxDistanceMm)),
      key("max_exposed", &Believability::max_exposed_mm2, number(0, 1e6))
          .with_starter_lines([](const StarterFacts& facts) -> std::optional<StarterLines> {
            if (facts.vertex_count > kMaxJudged) return std::nullopt;
            return StarterLines{"0.5",
                                "skin that shows its back, in mm²: specks at nostrils and lips"};
          }),
      word_key("meshes", &Believability::meshes)
          .with_starter_lines([](const StarterFacts& facts) -> std::optional<StarterLines> {
            if (facts.vertex_count > kMaxJudged) return std::nullopt;
            return StarterLines{std::string(word_of(Believability::MeshChecks::kJudge)), "",
                                "Casting builds each face and drops it if too much skin passes "
                                "through other skin: lips, lids."};
          })};
  return keys;
}

void read_first_distances(const YamlNode& node, DiversityOptions& diversity, ConfigDraft& draft) {
  draft.complaints.expect_map(node, "a mapping from numbers of faces to lengths, {24: 1.2 mm}");
  for (const YamlEntry& entry : node.entries) {
    const auto faces = parse_unsigned(entry.key);
    if (!faces) {
      draft.complaints.add(
          entry.key_place,
          concat(node.path, ": expected a number of faces, found ", quoted(entry.key)));
    } else if (const auto mm = length(kMaxDistanceMm).read(entry.value, draft)) {
      diversity.min_distance_mm_up_to_face[*faces] = *mm;
    }
  }
  if (!node.entries.empty() && diversity.mode != DiversityOptions::Mode::kFirstFit) {
    draft.complaints.add_at(node, "requires mode: first_fit");
  }
}

std::string write_first_distances(const DiversityOptions& diversity, const WriteContext& context) {
  const auto entries = texts_of(diversity.min_distance_mm_up_to_face, [&](const auto& first) {
    return yaml_entry(std::to_string(first.first),
                      length(kMaxDistanceMm).write(first.second, context));
  });
  return entries.empty() ? "" : yaml_flow_map(entries);
}

/// Makes an obsolete key. The configs of older crowds contain the key with the value `value`. The
/// key accepts only this value and has no effect.
Key<DiversityOptions> removed_key(std::string_view name, std::string_view value) {
  return {name,
          [=](const YamlNode& node, auto&, ConfigDraft& draft) {
            if (node.text != value) {
              draft.complaints.add_at(node, "crowdface no longer has this key; remove it");
            }
          },
          [](const auto&...) { return ""; }};
}

}  // namespace

const Keys<Config::Distance>& distance_keys() {
  static const Keys<Config::Distance> keys = {
      word_key("area", &Config::Distance::area),
      Key<Config::Distance>{"mask", read_mask, write_mask}.with_accepted_values("image file")};
  return keys;
}

namespace {

/// Proposes a value for `diversity.min_distance` that all faces of the starter config's crowd can
/// keep without exceeding the config's believability limits.
std::optional<StarterLines> min_distance_starter(const StarterFacts& facts) {
  const std::size_t in_group = head_count_of_rarer_sex(facts);
  const std::size_t heads = in_group > 0 ? in_group : facts.head_names.size();
  struct Proposal {
    std::size_t heads;  ///< smallest number of heads for which `distance` is proposed
    const char* distance;
  };
  constexpr std::size_t kHeadsFor1Mm = 5;  // smallest number of heads for a distance of 1 mm
  constexpr Proposal kProposals[] = {
      {8, "1.2 mm"}, {kHeadsFor1Mm, "1 mm"}, {4, "0.8 mm"}, {3, "0.5 mm"}};
  const auto* found = std::ranges::find_if(
      kProposals, [&](const Proposal& proposal) { return heads >= proposal.heads; });
  if (found == std::end(kProposals)) return std::nullopt;
  return StarterLines{
      found->distance, "",
      heads >= kHeadsFor1Mm
          ? "No two people come nearer than this to each other: below 1 mm they look like one "
            "person.\nA large crowd needs a smaller distance (crowdface plan --estimate), a group "
            "of "
            "few heads too:\n1 mm for 5 heads, 0.8 mm for 4, 0.5 mm for 3."
          : "No two people come nearer than this to each other. Below 1 mm they look like one "
            "person,\nbut so few heads give no faces that are farther apart."};
}

}  // namespace

const Keys<DiversityOptions>& diversity_keys() {
  using Diversity = DiversityOptions;
  static const Keys<Diversity> keys = {
      word_key("mode", &Diversity::mode),
      key("min_distance", &Diversity::min_distance_mm, length(kMaxDistanceMm))
          .with_starter_lines(min_distance_starter),
      Key<Diversity>{"min_distance_of_first", read_first_distances, write_first_distances}
          .with_accepted_values("`{number of faces: length}`"),
      key("min_distance_to_faces", &Diversity::min_distance_to_heads_mm, length(kMaxDistanceMm))
          .with_starter_lines(
              {"0.8 mm", "",
               "No face comes nearer than this to a head: below half a millimetre it looks "
               "like that person."}),
      key("min_distance_to_rejected", &Diversity::min_distance_to_rejected_mm,
          length(kMaxDistanceMm)),
      key("max_weight", &Diversity::max_weight, nonzero(number(0, 1), "a number above 0, up to 1")),
      {"quotas", refuse_quotas, [](const auto&...) { return ""; }},
      removed_key("candidates", {}),
      removed_key("pool", "10"),
      removed_key("max_attempts", "1000")};
  return keys;
}

namespace {

void read_believability(const YamlNode& node, Config& config, ConfigDraft& draft) {
  config.believability->check = !is_word(node, "none");
  if (config.believability->check) {
    read_keys(node, believability_keys(), *config.believability, draft);
  }
}

std::string write_believability(const Config& config, const WriteContext& context) {
  if (!config.believability->check) return "none";
  return yaml_block_map(write_keys(believability_keys(), *config.believability, context));
}

}  // namespace

Key<Config> believability_key() {
  return Key<Config>{"believability",
                     read_believability,
                     write_believability,
                     {},
                     starter_section(believability_keys())}
      .with_nested_keys(believability_keys());
}

}  // namespace crowdface
