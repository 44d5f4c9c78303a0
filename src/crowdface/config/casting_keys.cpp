// SPDX-License-Identifier: Apache-2.0
// The sections `distance`, `diversity` and `believability`: how faces are compared and what they
// must keep.
#include <algorithm>

#include "crowdface/config/config_keys.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

constexpr double kMaxDistance = 1000;  // mm
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

/// No head may count for two quotas: the shares of both could not be kept apart.
void refuse_shared_heads(const YamlEntry& entry, const Quota& quota, ConfigDraft& draft) {
  for (const Quota& other : draft.config.diversity.quotas) {
    for (const Eigen::Index head : quota.heads) {
      if (std::find(other.heads.begin(), other.heads.end(), head) == other.heads.end()) continue;
      const std::string& name = draft.config.faces.names[static_cast<std::size_t>(head)];
      draft.complaints.add(entry.key_place,
                           concat(entry.value.path, ": the head ", quoted(name), " counts for ",
                                  quoted(other.name), " already; quotas share no heads"));
      return;
    }
  }
}

bool is_target(Eigen::Index head, const ConfigDraft& draft) {
  const auto& targets = draft.config.sampling.targets;
  return std::any_of(targets.begin(), targets.end(),
                     [&](const WeightedHead& target) { return target.head == head; });
}

void read_quotas(const YamlNode& node, DiversityOptions& diversity, ConfigDraft& draft) {
  draft.complaints.expect_map(node, "a mapping from heads or tags to shares, {old: 0.3}");
  auto& quotas = diversity.quotas;
  double total = 0;
  for (const YamlEntry& entry : node.entries) {
    Quota quota;
    quota.name = entry.key;
    quota.heads = find_heads(entry.key, entry.key_place, node.path, draft);
    const auto share = read_number(entry.value, 0, 1, draft.complaints);
    if (quota.heads.empty() || !share) continue;
    quota.share = *share;
    total += *share;
    refuse_shared_heads(entry, quota, draft);
    if (*share > 0 && std::none_of(quota.heads.begin(), quota.heads.end(),
                                   [&](Eigen::Index head) { return is_target(head, draft); })) {
      draft.complaints.add(
          entry.key_place,
          concat(entry.value.path, ": none of its heads is among sampling.targets"));
    }
    quotas.push_back(std::move(quota));
  }
  if (total > 1 + kShareRounding) {
    draft.complaints.about(node, concat("the shares sum to ", total, "; at most 1 is possible"));
  }
  const auto& targets = draft.config.sampling.targets;
  const bool some_left =
      std::any_of(targets.begin(), targets.end(), [&](const WeightedHead& target) {
        return std::none_of(quotas.begin(), quotas.end(), [&](const Quota& quota) {
          return std::find(quota.heads.begin(), quota.heads.end(), target.head) !=
                 quota.heads.end();
        });
      });
  if (!quotas.empty() && !targets.empty() && !some_left && total < 1 - kShareRounding) {
    draft.complaints.about(
        node, concat("the shares sum to ", total,
                     ", but every target counts for one of them; for whom is the rest?"));
  }
}

std::string write_quotas(const DiversityOptions& diversity, const ConfigWriting&) {
  std::vector<std::string> quotas;
  for (const Quota& quota : diversity.quotas) {
    quotas.push_back(entry(write_scalar(quota.name), format_number(quota.share)));
  }
  return flow_map(quotas);
}

Codec<double> max_weight() {
  Codec<double> codec = number(0, 1);
  codec.read = [read = codec.read](const YamlNode& node, ConfigDraft& draft) {
    const auto weight = read(node, draft);
    if (weight == 0.0) draft.complaints.expected(node, "a number above 0, up to 1");
    return weight;
  };
  return codec;
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
      key("max_weight", &Diversity::max_weight, max_weight()),
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
