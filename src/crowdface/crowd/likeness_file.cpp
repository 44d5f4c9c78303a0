// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/likeness_file.h"

#include <array>
#include <map>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"

namespace crowdface {

using Json = nlohmann::ordered_json;

namespace {

/// Parses likeness.json value by value, without building a JSON tree. Stops at the first unexpected
/// value.
class LikenessReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit LikenessReader(const std::vector<std::string>& ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) rows_.emplace(ids[i], i);
    likeness.neighbours.resize(ids.size());
  }

  std::map<std::string, std::vector<double>> anchors;
  Likeness likeness;
  /// number of faces for which the file lists the nearest faces
  std::size_t face_count_with_neighbours = 0;

  bool start_object(std::size_t) override { return ++depth_ <= kDeepest; }
  bool start_array(std::size_t) override { return ++depth_ <= kDeepest; }
  bool end_object() override { return depth_-- > 0; }
  bool end_array() override { return depth_-- > 0; }
  bool key(std::string& key) override {
    if (depth_ < 1) return false;
    keys_[depth_ - 1] = key;
    if (depth_ != 2 || keys_[0] != "nearest") return true;
    ++face_count_with_neighbours;
    return rows_.contains(key);
  }
  bool string(std::string& value) override {
    const auto row = rows_.find(value);
    if (depth_ != 2 || keys_[0] != "order" || row == rows_.end()) return false;
    likeness.face_order.push_back(row->second);
    return true;
  }
  bool number_float(double value, const std::string&) override {
    if (depth_ != kDeepest) return false;
    if (keys_[0] == "heads") {
      anchors[keys_[1]].push_back(value);
      return true;
    }
    const auto face = rows_.find(keys_[1]), other = rows_.find(keys_[2]);
    if (keys_[0] != "nearest" || face == rows_.end() || other == rows_.end()) return false;
    likeness.neighbours[face->second].push_back({other->second, value});
    return true;
  }
  bool number_integer(std::int64_t value) override {
    return number_float(static_cast<double>(value), {});
  }
  bool number_unsigned(std::uint64_t value) override {
    return number_float(static_cast<double>(value), {});
  }
  bool null() override { return false; }
  bool boolean(bool) override { return false; }
  bool binary(nlohmann::json::binary_t&) override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  static constexpr std::size_t kDeepest = 3;

  std::unordered_map<std::string, std::size_t> rows_;
  std::size_t depth_ = 0;
  /// keys of the JSON objects that enclose the current value
  std::array<std::string, kDeepest> keys_;
};

}  // namespace

CrowdLikeness crowd_likeness(const std::vector<PlanePoint>& anchors,
                             const std::vector<FaceSpace::Point>& points) {
  constexpr std::size_t kNeighbours = 6;  // per face: fills two rows of the gallery page
  CrowdLikeness likeness{anchors, find_likeness(points, kNeighbours)};
  for (std::vector<Neighbour>& near : likeness.likeness.neighbours) {
    for (Neighbour& other : near) other.distance_mm = rounded(other.distance_mm);
  }
  return likeness;
}

TextPieces likeness_text(const CrowdLikeness& likeness, const PlanNames& names,
                         const std::vector<std::string>& ids) {
  const auto start = [](std::size_t i) { return i > 0 ? ",\n  " : "\n  "; };
  return [&, start](const TextSink& take) {
    Json heads = {{"heads", Json::object()}};
    for (std::size_t h = 0; h < names.heads.size(); ++h) {
      heads["heads"][names.heads[h]] = {likeness.anchors[h].x(), likeness.anchors[h].y()};
    }
    std::string text = heads.dump(1);
    text.resize(text.size() - std::string_view("\n}").size());
    take(text + ",\n \"order\": [");
    const std::vector<std::size_t>& order = likeness.likeness.face_order;
    text_of_items(order.size(), [&](std::size_t i) {
      return concat(start(i), Json(ids[order[i]]).dump());
    })(take);
    take(order.empty() ? "],\n \"nearest\": {" : "\n ],\n \"nearest\": {");
    text_of_items(ids.size(), [&](std::size_t face) {
      std::string line = concat(start(face), Json(ids[face]).dump(), ": {");
      const std::vector<Neighbour>& near = likeness.likeness.neighbours[face];
      for (std::size_t n = 0; n < near.size(); ++n) {
        line += concat(n > 0 ? ",\n   " : "\n   ", Json(ids[near[n].face]).dump(), ": ",
                       Json(near[n].distance_mm).dump());
      }
      return line + (near.empty() ? "}" : "\n  }");
    })(take);
    take(ids.empty() ? "}\n}\n" : "\n }\n}\n");
  };
}

CrowdLikeness read_likeness(const std::filesystem::path& path, const PlanNames& names,
                            const std::vector<std::string>& ids) {
  const MappedFile file(path);
  LikenessReader reader(ids);
  CrowdLikeness result;
  if (nlohmann::json::sax_parse(file.bytes(), &reader)) {
    for (const std::string& head : names.heads) {
      const auto anchor = reader.anchors.find(head);
      if (anchor == reader.anchors.end() || anchor->second.size() != 2) break;
      result.anchors.emplace_back(anchor->second[0], anchor->second[1]);
    }
    result.likeness = std::move(reader.likeness);
    if (result.anchors.size() == names.heads.size() &&
        reader.face_count_with_neighbours == ids.size() &&
        result.likeness.face_order.size() == ids.size()) {
      return result;
    }
  }
  throw InvalidInput(
      concat(path.string(), ": expected the likeness of the faces in plan.jsonl, ",
             "found other contents; run crowdface generate to write the file again"));
}

}  // namespace crowdface
