// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/compared_area.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/normals.h"

namespace crowdface {
namespace {

/// Returns the coordinate half-way between the foremost and the hindmost vertex of the skin, along
/// the front axis.
double middle_of_skin(const Components& components, const Positions& mean, Axis front) {
  const std::uint32_t skin = components.largest();
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (Index i = 0; i < mean.rows(); ++i) {
    if (components.component_of_vertex[static_cast<std::size_t>(i)] != skin) continue;
    low = std::min(low, front.sign * mean(i, front.index));
    high = std::max(high, front.sign * mean(i, front.index));
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<double> compared_vertex_areas(const Topology& topology, const Components& components,
                                          const Positions& mean, ComparedArea area, Axis front,
                                          const std::vector<double>& mask) {
  const std::uint32_t skin = components.largest();
  const double middle =
      area == ComparedArea::kFront ? middle_of_skin(components, mean, front) : -HUGE_VAL;
  std::vector<double> areas(static_cast<std::size_t>(mean.rows()), 0.0);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Eigen::Vector3d twice = face_area_vector(topology, f, mean);
    const auto face = topology.face(f);
    const double share = 0.5 * std::sqrt(twice.squaredNorm()) / static_cast<double>(face.size());
    for (const std::uint32_t i : face) {
      if (components.component_of_vertex[i] == skin &&
          front.sign * mean(i, front.index) >= middle) {
        areas[i] += share;
      }
    }
  }
  for (std::size_t i = 0; i < mask.size(); ++i) areas[i] *= mask[i];
  return areas;
}

}  // namespace crowdface
