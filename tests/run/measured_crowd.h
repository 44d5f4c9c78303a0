// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/crowd_files.h"
#include "support/reference_distance.h"
#include "support/small_crowd.h"

namespace crowdface::testing {

inline constexpr double kMmPerCm = 10;
/// Meshes hold seven digits, and samples are all vertices of so small a head.
inline constexpr double kTolerance = 0.01;  // mm

inline SmallCrowd six_bowls() {
  SmallCrowd crowd;
  crowd.heads = 6;
  crowd.regions = 3;
  crowd.count = 12;
  crowd.sampling = "{smoothness: [0.2, 0.9], extrapolation: [0.9, 1.1]}";
  return crowd;
}

/// The faces of a crowd as written, and the same recipes with every factor 1 by the plain method.
struct Measured {
  explicit Measured(const SmallCrowdFolder& folder, const std::string& out = "out")
      : lines(plan_lines(folder / out)) {
    const reference::Heads heads = folder.reference_heads();
    std::vector<reference::Points> all;
    for (const std::string& name : folder.names()) all.push_back(heads.positions.at(name));
    areas = reference::front_areas(reference::read_obj(folder.head(folder.names()[0])), all);
    for (const std::string& name : folder.names()) head_positions[name] = heads.positions.at(name);
    for (nlohmann::json line : lines) {
      const auto id = line.at("id").get<std::string>();
      as_built.push_back(reference::read_obj(folder / out / "meshes" / (id + ".obj")).vertices);
      for (auto& region : line.at("regions")) region["extrapolation"] = 1.0;
      unit.push_back(reference::blend(heads, line));
    }
  }

  double between(std::size_t a, std::size_t b) const {
    return std::min(reference::distance_mm(areas, as_built[a], as_built[b], kMmPerCm),
                    reference::distance_mm(areas, unit[a], unit[b], kMmPerCm));
  }
  double to_head(std::size_t face, const std::string& head) const {
    const reference::Points& other = head_positions.at(head);
    return std::min(reference::distance_mm(areas, as_built[face], other, kMmPerCm),
                    reference::distance_mm(areas, unit[face], other, kMmPerCm));
  }

  std::vector<nlohmann::json> lines;
  std::vector<double> areas;
  std::map<std::string, reference::Points> head_positions;
  std::vector<reference::Points> as_built, unit;
};

inline double closest_pair(const Measured& faces) {
  double closest = HUGE_VAL;
  for (std::size_t a = 0; a < faces.lines.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) closest = std::min(closest, faces.between(a, b));
  }
  return closest;
}

}  // namespace crowdface::testing
