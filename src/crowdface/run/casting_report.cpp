// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/casting_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/cast/attachment_sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/config/words.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/log.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Quartiles& q) {
  if (q.count == 0) return nullptr;
  return {{"pairs", q.count},
          {"min", rounded(q.min)},
          {"quarter", rounded(q.lower_quartile)},
          {"median", rounded(q.median)},
          {"three_quarters", rounded(q.upper_quartile)},
          {"max", rounded(q.max)}};
}

/// Converts the quartiles of the distances from each face to its nearest neighbour. Omits the key
/// "pairs" (the number of pairs of faces), because not all pairs are measured.
Json nearest_to_json(const Quartiles& q) {
  Json json = to_json(q);
  if (json.is_object()) json.erase("pairs");
  return json;
}

Json distances_to_json(const std::vector<std::string>& regions, const CrowdDistances& distances) {
  Json json;
  json["between_heads_mm"] = to_json(distances.between_heads);
  json["between_faces_mm"] = to_json(distances.between_faces);
  json["median_ratio"] = distances.face_to_head_median_ratio > 0
                             ? Json(rounded(distances.face_to_head_median_ratio))
                             : Json();
  for (std::size_t k = 0; k < distances.between_faces_by_region.size(); ++k) {
    json["between_faces_by_region_mm"][regions[k]] = to_json(distances.between_faces_by_region[k]);
  }
  json["to_nearest_head_mm"] = nearest_to_json(distances.to_nearest_head);
  json["to_nearest_earlier_face_mm"] = nearest_to_json(distances.to_nearest_face);
  return json;
}

Json asked_to_json(const DiversityOptions& diversity) {
  return {{"mode", word_of(diversity.mode)},
          {"min_distance_mm", diversity.min_distance_mm},
          {"min_distance_to_faces_mm", diversity.min_distance_to_heads_mm},
          {"max_weight", diversity.max_weight}};
}

/// Returns the number of faces in each group, and the distances between the faces of each group.
Json groups_to_json(const std::vector<Group>& groups, const CrowdPlan& crowd_plan) {
  Json json = Json::object();
  for (const Group& group : groups) {
    std::vector<FaceSpace::Point> points;
    for (std::size_t i = 0; i < crowd_plan.crowd.size(); ++i) {
      if (crowd_plan.crowd[i].group == group.name) points.push_back(crowd_plan.points[i]);
    }
    json[group.name] = {{"faces", points.size()},
                        {"within_mm", to_json(quartiles(pair_distances(points)))}};
  }
  return json;
}

/// Returns the number of faces for each tag. A face counts for each tag of its typical head (see
/// typical_head).
Json tags_to_json(const Config& config, const CrowdPlan& crowd_plan) {
  Json json = Json::object();
  for (const FacePlan& face : crowd_plan.crowd) {
    const Index head = typical_head(face.recipe, config.faces.tags);
    for (const std::string& tag : config.faces.tags[static_cast<std::size_t>(head)]) {
      json[tag] = json.value(tag, 0U) + 1U;
    }
  }
  return json;
}

/// Returns, for each kind, name and colour of attachments, the number of faces that wear such an
/// attachment. The result also has the quotas for sampled faces.
Json attachments_to_json(const Config::Attachments& attachments, const CrowdPlan& crowd_plan) {
  const auto wears = [&](const FacePlan& face, const std::string& word) {
    return std::any_of(attachments.items.begin(), attachments.items.end(), [&](const auto& item) {
      return matches_kind_name_or_colour(item, word) && contains(face.attachments, item.name);
    });
  };
  const auto count = [&](const std::string& word) {
    return std::count_if(crowd_plan.crowd.begin(), crowd_plan.crowd.end(),
                         [&](const FacePlan& face) { return wears(face, word); });
  };
  Json json = {{"kinds", Json::object()}, {"colours", Json::object()}, {"quotas", Json::object()}};
  for (const Config::Attachment& item : attachments.items) {
    Json& kind = json["kinds"][item.kind];
    kind["faces"] = count(item.kind);
    kind["items"][item.name] = count(item.name);
    if (!item.colour.empty()) json["colours"][item.colour] = count(item.colour);
  }
  for (const auto& [word, share] : attachments.quotas) {
    const auto faces = std::count_if(
        crowd_plan.crowd.begin(), crowd_plan.crowd.end(),
        [&, &asked = word](const FacePlan& face) { return face.index && wears(face, asked); });
    json["quotas"][word] = {{"share", share}, {"faces", faces}};
  }
  return json;
}

Json rejections_to_json(const RejectionCounts& rejections) {
  Json json = Json::object();
  for (std::size_t r = 0; r < kReasonCount; ++r) {
    const auto reason = static_cast<RejectionReason>(r);
    const bool is_rare = reason == RejectionReason::kRejected || reason == RejectionReason::kTraits;
    if (is_rare && rejections.counts[r] == 0) continue;
    json[std::string(name_of(static_cast<RejectionReason>(r)))] = rejections.counts[r];
  }
  return json;
}

Json families_to_json(const CrowdPlan& crowd_plan) {
  Json json = Json::array();
  for (const FamilyReport& family : crowd_plan.families) {
    json.push_back({{"name", family.name},
                    {"members", family.member_count},
                    {"within_mm", to_json(family.member_distances)},
                    {"to_founder_mm", nearest_to_json(family.founder_distances)},
                    {"nearest_other_mm", rounded(family.nearest_outsider_mm)},
                    {"silhouette", rounded(family.silhouette_coefficient)}});
    if (family.fraction_of_strangers_nearer_than_parent) {
      json.back()["strangers_nearer_than_a_parent"] =
          rounded(*family.fraction_of_strangers_nearer_than_parent);
    }
  }
  return json;
}

Json trait_to_json(const TraitReport& report) {
  Json json = {{"heads", nearest_to_json(report.head_values)},
               {"crowd", nearest_to_json(report.crowd_values)}};
  if (report.comparison) {
    json["population"] = {{"asked_mean", report.comparison->target.mean},
                          {"asked_deviation", report.comparison->target.deviation},
                          {"mean", rounded(report.comparison->mean)},
                          {"deviation", rounded(report.comparison->standard_deviation)},
                          {"largest_difference", rounded(report.comparison->max_difference)},
                          {"asked_below_reach", rounded(report.comparison->fraction_below)},
                          {"asked_above_reach", rounded(report.comparison->fraction_above)}};
  }
  return json;
}

}  // namespace

std::vector<std::string> warnings_about_faces_near_heads(const CrowdPlan& crowd_plan,
                                                         const std::vector<std::string>& heads) {
  constexpr std::size_t kMaxNamed = 8;
  std::vector<std::string> near;
  for (const FacePlan& face : crowd_plan.crowd) {
    if (!face.index || !face.notes.nearest ||
        face.notes.nearest->head_distance_mm >= DiversityOptions::kSamePersonMm)
      continue;
    near.push_back(concat(face.id, " (", heads[static_cast<std::size_t>(face.notes.nearest->head)],
                          ", ", format_fixed(face.notes.nearest->head_distance_mm, 2), " mm)"));
  }
  if (near.empty()) return {};
  const std::size_t count = near.size();
  near.resize(std::min(count, kMaxNamed));
  return {concat(count, count == 1 ? " face passes" : " faces pass",
                 " for one of the heads: ", join(near), count > kMaxNamed ? ", …" : "",
                 "; a larger diversity.min_distance_to_faces keeps faces away from the heads")};
}

void log_casting(const CrowdPlan& crowd_plan) {
  const CrowdDistances& distances = crowd_plan.distances;
  const auto mm = [](double value) { return format_fixed(value, 2); };
  if (distances.between_faces.count > 0) {
    log_info(concat("distances between faces: closest ", mm(distances.between_faces.min),
                    " mm, median ", mm(distances.between_faces.median),
                    " mm; between the input heads: closest ", mm(distances.between_heads.min),
                    " mm, median ", mm(distances.between_heads.median),
                    " mm; ratio of the medians ", mm(distances.face_to_head_median_ratio)));
  }
  std::vector<std::string> thrown;
  for (std::size_t r = 0; r < kReasonCount; ++r) {
    const std::uint64_t count = crowd_plan.rejections.counts[r];
    if (count > 0)
      thrown.push_back(concat(count, " for ", name_of(static_cast<RejectionReason>(r))));
  }
  if (!thrown.empty()) log_info(concat("candidates rejected: ", join(thrown)));
}

Json casting_to_json(const Config& config, const CrowdPlan& crowd_plan) {
  Json json;
  json["asked"] = asked_to_json(*config.diversity);
  json["faces"] = crowd_plan.crowd.size();
  json["distances"] = distances_to_json(config.region_names(), crowd_plan.distances);
  if (!config.groups.empty()) json["groups"] = groups_to_json(config.groups, crowd_plan);
  if (Json tags = tags_to_json(config, crowd_plan); !tags.empty()) json["tags"] = std::move(tags);
  if (!config.attachments.items.empty()) {
    json["attachments"] = attachments_to_json(config.attachments, crowd_plan);
  }
  json["families"] = families_to_json(crowd_plan);
  for (const TraitReport& report : crowd_plan.traits) {
    json["traits"][std::string(measurements()[report.trait_index].name)] = trait_to_json(report);
  }
  json["thrown_away"] = rejections_to_json(crowd_plan.rejections);
  return json;
}

}  // namespace crowdface
