// SPDX-License-Identifier: Apache-2.0
// The sections `distance`, `diversity` and `believability`: how faces are compared and what they
// must keep.
#include <algorithm>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/contains.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kMostCandidates = 1000;
constexpr std::uint64_t kLargestPool = 1000;
constexpr std::uint64_t kMostAttempts = 1'000'000;
constexpr double kShareRounding = 1e-9;
constexpr Eigen::Index kMostJudged = 200'000;  // vertices of heads whose meshes a starter judges

/// One image, or a set of UDIM tiles.
void read_mask(const YamlNode& node, Config::Distance& distance, ConfigDraft& draft) {
  const auto mask = path("an image file").read(node, draft);
  if (!mask) return;
  distance.mask = mask->string();
  if (distance.mask->find(kTileWord) == std::string::npos) expect_file(node, *mask, draft);
}

std::string write_mask(const Config::Distance& distance, const ConfigWriting& writing) {
  return distance.mask ? path("").write(*distance.mask, writing) : "";
}

bool is_target(Eigen::Index head, const ConfigDraft& draft) {
  const auto& targets = draft.config.sampling.targets;
  return std::ranges::find(targets, head, &WeightedHead::head) != targets.end();
}

/// No head may count for two quotas of one kind: the shares of both could not be kept apart.
void refuse_shared_heads(const YamlEntry& entry, const Quota& quota, ConfigDraft& draft) {
  for (const Quota& other : draft.config.diversity.quotas) {
    if (other.band != quota.band) continue;
    for (const Eigen::Index head : quota.heads) {
      if (!contains(other.heads, head)) continue;
      const std::string& name = draft.config.faces.names[static_cast<std::size_t>(head)];
      draft.complaints.add(entry.key_place,
                           concat(entry.value.path, ": the head ", quoted(name), " counts for ",
                                  quoted(other.name), " already; quotas share no heads"));
      return;
    }
  }
}

const Keys<Quota>& quota_keys() {
  static const Keys<Quota> keys = {
      key("share", &Quota::share, number(0, 1), "from 0 to 1"),
      {"band",
       [](const YamlNode& node, Quota& quota, ConfigDraft& draft) {
         const auto name = read_name(node, draft.complaints);
         const auto& bands = draft.config.sampling.bands;
         const auto band = std::ranges::find(bands, name, &BandSampling::name);
         if (band != bands.end()) {
           quota.band = static_cast<std::size_t>(band - bands.begin());
         } else if (name) {
           draft.complaints.about(node,
                                  concat("no band of sampling.bands is called ", quoted(*name)));
         }
       },
       [](const Quota& quota, const ConfigWriting& writing) {
         return quota.band ? write_scalar(writing.config.sampling.bands[*quota.band].name) : "";
       }}};
  return keys;
}

/// Heads of a band's quotas, or of those of targets.
bool counts_for_any(const std::vector<Quota>& quotas, std::optional<std::size_t> band,
                    Eigen::Index head) {
  return std::ranges::any_of(quotas, [&](const Quota& quota) {
    return quota.band == band && contains(quota.heads, head);
  });
}

double total_share(const std::vector<Quota>& quotas, std::optional<std::size_t> band) {
  double total = 0;
  for (const Quota& quota : quotas) total += quota.band == band ? quota.share : 0;
  return total;
}

/// Faces that count for no quota need heads too.
void refuse_nothing_left(const YamlNode& node, ConfigDraft& draft) {
  const auto& quotas = draft.config.diversity.quotas;
  const SamplingOptions& sampling = draft.config.sampling;
  const auto& targets = sampling.targets;
  const double total = total_share(quotas, std::nullopt);
  const bool targets_left = std::ranges::any_of(targets, [&](const WeightedHead& target) {
    return !counts_for_any(quotas, std::nullopt, target.head);
  });
  if (!targets.empty() && !targets_left && total < 1 - kShareRounding) {
    draft.complaints.about(
        node, concat("the shares sum to ", total,
                     ", but every target counts for one of them; for whom is the rest?"));
  }
  for (std::size_t b = 0; b < sampling.bands.size(); ++b) {
    const auto& sources = sources_of(sampling, b);
    const double of_band = total_share(quotas, b);
    if (of_band == 0 || of_band > 1 - kShareRounding || sources.empty()) continue;
    if (std::ranges::any_of(sources,
                            [&](Eigen::Index head) { return !counts_for_any(quotas, b, head); })) {
      continue;
    }
    draft.complaints.about(
        node, concat("the shares of the band ", sampling.bands[b].name, " sum to ", of_band,
                     ", but every source counts for one of them; for whom is the rest?"));
  }
}

/// Whether any of its heads may be what it binds.
bool can_be_met(const Quota& quota, const ConfigDraft& draft) {
  return std::ranges::any_of(quota.heads, [&](Eigen::Index head) {
    if (!quota.band) return is_target(head, draft);
    return contains(sources_of(draft.config.sampling, *quota.band), head);
  });
}

void read_quotas(const YamlNode& node, DiversityOptions& diversity, ConfigDraft& draft) {
  draft.complaints.expect_map(node, "a mapping from heads or tags to shares, {old: 0.3}");
  auto& quotas = diversity.quotas;
  double total = 0;
  for (const YamlEntry& entry : node.entries) {
    const std::size_t complaints_before = draft.complaints.size();
    Quota quota;
    quota.name = entry.key;
    quota.heads = find_heads(entry.key, entry.key_place, node.path, draft);
    if (entry.value.kind == YamlNode::Kind::kMap) {
      read_keys(entry.value, quota_keys(), quota, draft);
    } else {
      quota_keys().front().read(entry.value, quota, draft);
    }
    if (quota.heads.empty() || draft.complaints.size() != complaints_before) continue;
    total += quota.share;
    refuse_shared_heads(entry, quota, draft);
    if (quota.share > 0 && !can_be_met(quota, draft)) {
      draft.complaints.add(
          entry.key_place,
          quota.band ? concat(entry.value.path, ": none of its heads is among the band's sources")
                     : concat(entry.value.path, ": none of its heads is among sampling.targets"));
    }
    quotas.push_back(std::move(quota));
  }
  if (total > 1 + kShareRounding) {
    draft.complaints.about(node, concat("the shares sum to ", total, "; at most 1 is possible"));
  }
  if (!quotas.empty()) refuse_nothing_left(node, draft);
}

std::string write_quotas(const DiversityOptions& diversity, const ConfigWriting& writing) {
  return flow_map(texts_of(diversity.quotas, [&](const Quota& quota) {
    return entry(write_scalar(quota.name), quota.band
                                               ? flow_map(write_keys(quota_keys(), quota, writing))
                                               : format_number(quota.share));
  }));
}

const Keys<BelievabilityOptions>& believability_keys() {
  using Believability = BelievabilityOptions;
  static const Keys<Believability> keys = {
      key("max_deviation", &Believability::max_deviation, number(0, 1000)),
      key("max_stretch", &Believability::max_stretch, number(1, 1000)),
      key("max_flipped", &Believability::max_flipped, number(0, 1)),
      key("max_intersecting", &Believability::max_intersecting, number(0, 1)),
      key("max_gap", &Believability::max_gap_mm, length(kMaxDistance)),
      key("max_exposed", &Believability::max_exposed_mm2, number(0, 1e6))
          .in_starter([](const StarterFacts& facts) -> std::optional<StarterLines> {
            if (facts.vertices > kMostJudged) return std::nullopt;
            return StarterLines{"0.5",
                                "mm² of skin that shows its back: specks at nostrils and lips"};
          }),
      word_key("meshes", &Believability::meshes)
          .in_starter([](const StarterFacts& facts) -> std::optional<StarterLines> {
            if (facts.vertices > kMostJudged) return std::nullopt;
            return StarterLines{std::string(word_of(Believability::Meshes::kJudge)), "",
                                "Casting builds each face and drops it if too much skin passes "
                                "through other skin: lips, lids."};
          })};
  return keys;
}

}  // namespace

const Keys<Config::Distance>& distance_keys() {
  static const Keys<Config::Distance> keys = {word_key("area", &Config::Distance::area),
                                              {"mask", read_mask, write_mask}};
  return keys;
}

const Keys<DiversityOptions>& diversity_keys() {
  using Diversity = DiversityOptions;
  static const Keys<Diversity> keys = {
      word_key("mode", &Diversity::mode),
      key("min_distance", &Diversity::min_distance_mm, length(kMaxDistance)),
      key("min_distance_to_faces", &Diversity::min_distance_to_faces_mm, length(kMaxDistance))
          .in_starter({"0.8 mm", "",
                       "No face comes nearer to one of the heads: below half a millimetre it is "
                       "that person."}),
      key("min_distance_to_rejected", &Diversity::min_distance_to_rejected_mm,
          length(kMaxDistance)),
      key("max_weight", &Diversity::max_weight,
          above_zero(number(0, 1), "a number above 0, up to 1")),
      {"quotas", read_quotas, write_quotas},
      key("candidates", &Diversity::candidates, whole(1, kMostCandidates)),
      key("pool", &Diversity::pool, whole(1, kLargestPool)),
      key("max_attempts", &Diversity::max_attempts, whole(1, kMostAttempts))};
  return keys;
}

void read_believability(const YamlNode& node, Config& config, ConfigDraft& draft) {
  config.believability.check = !is_word(node, "none");
  if (config.believability.check) {
    read_keys(node, believability_keys(), config.believability, draft);
  }
}

Starter believability_starter() {
  return starter_section(believability_keys());
}

std::string write_believability(const Config& config, const ConfigWriting& writing) {
  if (!config.believability.check) return "none";
  return block_map(write_keys(believability_keys(), config.believability, writing));
}

}  // namespace crowdface
