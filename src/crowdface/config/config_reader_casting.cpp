// SPDX-License-Identifier: Apache-2.0
// The sections `distance`, `diversity` and `believability`: how faces are compared and what they
// must keep.
#include <algorithm>

#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

constexpr double kMaxDistance = 1000;  // mm
constexpr std::uint64_t kMostCandidates = 1000;
constexpr std::uint64_t kLargestPool = 1000;
constexpr std::uint64_t kMostAttempts = 1'000'000;
constexpr double kShareRounding = 1e-9;

bool is_word(const YamlNode& node, std::string_view word) {
  return node.kind == YamlNode::Kind::kScalar && node.text == word;
}

void read_into(const YamlNode* node, std::uint64_t low, std::uint64_t high, int& value,
               ConfigDraft& draft) {
  if (node == nullptr) return;
  const auto whole = read_whole(*node, low, high, draft.complaints);
  if (whole) value = static_cast<int>(*whole);
}

void read_distance_into(const YamlNode* node, double& value, ConfigDraft& draft) {
  if (node == nullptr) return;
  value = read_length_mm(*node, kMaxDistance, draft.complaints).value_or(value);
}

/// One image, or a set of UDIM tiles.
void read_mask_path(const YamlNode& node, ConfigDraft& draft) {
  const auto text = read_text(node, "an image file", draft.complaints);
  if (!text) return;
  const std::string path = resolve(draft.folder, *text).string();
  if (path.find(kTileWord) == path.npos && !file_exists(path)) {
    draft.complaints.about(node, concat("the file ", quoted(path), " is missing"),
                           ExitCode::kMissingInput);
  }
  draft.config.distance.mask = path;
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

void read_quotas(const YamlNode& node, ConfigDraft& draft) {
  if (node.kind != YamlNode::Kind::kMap) {
    draft.complaints.expected(node, "a mapping from heads or tags to shares, {old: 0.3}");
    return;
  }
  auto& quotas = draft.config.diversity.quotas;
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
          concat(entry.value.path, ": none of its heads is among ", "sampling.targets"));
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
                     ", but every target counts for one of them; for whom is ", "the rest?"));
  }
}

}  // namespace

void read_distance(const YamlNode* node, ConfigDraft& draft) {
  const MapReader map(node, {"area", "mask"}, draft.complaints);
  if (const YamlNode* area = map.find("area")) {
    const Choices<FaceArea> choices = {{"front", FaceArea::kFront}, {"skin", FaceArea::kSkin}};
    draft.config.distance.area =
        read_choice(*area, choices, draft.complaints).value_or(FaceArea::kFront);
  }
  if (const YamlNode* mask = map.find("mask")) read_mask_path(*mask, draft);
}

void read_diversity(const YamlNode* node, ConfigDraft& draft) {
  DiversityOptions& diversity = draft.config.diversity;
  const MapReader map(node,
                      {"mode", "min_distance", "min_distance_to_faces", "max_weight", "quotas",
                       "candidates", "pool", "max_attempts"},
                      draft.complaints);
  using Mode = DiversityOptions::Mode;
  if (const YamlNode* mode = map.find("mode")) {
    const Choices<Mode> choices = {{"first_fit", Mode::kFirstFit}, {"spread", Mode::kSpread}};
    diversity.mode = read_choice(*mode, choices, draft.complaints).value_or(Mode::kFirstFit);
  }
  read_distance_into(map.find("min_distance"), diversity.min_distance_mm, draft);
  read_distance_into(map.find("min_distance_to_faces"), diversity.min_distance_to_faces_mm, draft);
  if (const YamlNode* weight = map.find("max_weight")) {
    diversity.max_weight = read_number(*weight, 0, 1, draft.complaints).value_or(1);
    if (diversity.max_weight == 0) draft.complaints.expected(*weight, "a number above 0, up to 1");
  }
  if (const YamlNode* quotas = map.find("quotas")) read_quotas(*quotas, draft);
  if (const YamlNode* candidates = map.find("candidates")) {
    int count = 0;
    read_into(candidates, 1, kMostCandidates, count, draft);
    if (count > 0) diversity.candidates = count;
  }
  read_into(map.find("pool"), 1, kLargestPool, diversity.pool, draft);
  read_into(map.find("max_attempts"), 1, kMostAttempts, diversity.max_attempts, draft);
}

void read_believability(const YamlNode* node, ConfigDraft& draft) {
  BelievabilityOptions& believability = draft.config.believability;
  if (node != nullptr && is_word(*node, "none")) {
    believability.check = false;
    return;
  }
  const MapReader map(node,
                      {"max_deviation", "max_stretch", "max_flipped", "max_intersecting", "meshes"},
                      draft.complaints);
  using Meshes = BelievabilityOptions::Meshes;
  if (const YamlNode* meshes = map.find("meshes")) {
    const Choices<Meshes> choices = {{"auto", Meshes::kAuto},
                                     {"all", Meshes::kAll},
                                     {"none", Meshes::kNone},
                                     {"judge", Meshes::kJudge}};
    believability.meshes = read_choice(*meshes, choices, draft.complaints).value_or(Meshes::kAuto);
  }
  const auto read = [&](std::string_view key, double low, double high, double& value) {
    const YamlNode* limit = map.find(key);
    if (limit != nullptr) {
      value = read_number(*limit, low, high, draft.complaints).value_or(value);
    }
  };
  read("max_deviation", 0, 1000, believability.max_deviation);
  read("max_stretch", 1, 1000, believability.max_stretch);
  read("max_flipped", 0, 1, believability.max_flipped);
  read("max_intersecting", 0, 1, believability.max_intersecting);
}

}  // namespace crowdface
