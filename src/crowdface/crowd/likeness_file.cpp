// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/likeness_file.h"

#include <stdexcept>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {

using Json = nlohmann::ordered_json;

CrowdLikeness crowd_likeness(const std::vector<PlanePoint>& anchors,
                             const std::vector<FaceSpace::Point>& points) {
  constexpr std::size_t kNeighbours = 6;  // of each face: two rows on its page of the gallery
  CrowdLikeness likeness{anchors, find_likeness(points, kNeighbours)};
  for (std::vector<Neighbour>& near : likeness.likeness.near) {
    for (Neighbour& other : near) other.mm = rounded(other.mm);
  }
  return likeness;
}

std::string format_likeness(const CrowdLikeness& likeness, const PlanNames& names,
                            const std::vector<std::string>& ids) {
  Json json;
  json["heads"] = Json::object();
  for (std::size_t h = 0; h < names.heads.size(); ++h) {
    json["heads"][names.heads[h]] = {likeness.anchors[h].x(), likeness.anchors[h].y()};
  }
  json["order"] = Json::array();
  for (const std::size_t face : likeness.likeness.order) json["order"].push_back(ids[face]);
  json["nearest"] = Json::object();
  for (std::size_t face = 0; face < ids.size(); ++face) {
    Json& near = json["nearest"][ids[face]] = Json::object();
    for (const Neighbour& other : likeness.likeness.near[face]) {
      near[ids[other.face]] = other.mm;
    }
  }
  return concat(json.dump(1), "\n");
}

CrowdLikeness read_likeness(const std::filesystem::path& path, const PlanNames& names,
                            const std::vector<std::string>& ids) {
  std::unordered_map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < ids.size(); ++i) rows.emplace(ids[i], i);
  const Json json = parse_shallow_json(read_file(path));
  CrowdLikeness result;
  try {
    for (const std::string& head : names.heads) {
      const Json& anchor = json.at("heads").at(head);
      result.anchors.emplace_back(anchor.at(0).get<double>(), anchor.at(1).get<double>());
    }
    for (const Json& id : json.at("order")) result.likeness.order.push_back(rows.at(id));
    for (const std::string& id : ids) {
      std::vector<Neighbour>& near = result.likeness.near.emplace_back();
      for (const auto& [other, mm] : json.at("nearest").at(id).items()) {
        near.push_back({rows.at(other), mm.get<double>()});
      }
    }
    if (result.likeness.order.size() == ids.size()) return result;
  } catch (const Json::exception&) {    // of another shape
  } catch (const std::out_of_range&) {  // names another crowd's face
  }
  throw InvalidInput(concat(path.string(), ": expected the likeness of the faces in plan.jsonl, ",
                            "found something else; crowdface generate writes it anew"));
}

}  // namespace crowdface
