// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/winding.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/normals.h"

namespace crowdface {
namespace {

constexpr Index kFacesPerBlock = 4096;

}  // namespace

float winding(const Topology& topology, const Positions& positions) {
  const Positions areas = face_area_vectors(topology, positions);
  const Eigen::RowVector3d middle = positions.colwise().mean();
  const auto sum = [&](auto&& term) {
    return parallel_sum(topology.face_count(), kFacesPerBlock, [&](Index begin, Index end) {
      double total = 0;
      for (Index f = begin; f < end; ++f) {
        if (topology.face(f).size() < 3) continue;
        const Eigen::RowVector3d reach = positions.row(topology.face(f)[0]) - middle;
        total += term(areas.row(f), reach);
      }
      return total;
    });
  };
  const double outward = sum([](const auto& area, auto& reach) { return area.dot(reach); });
  const double total =
      sum([](const auto& area, auto& reach) { return area.norm() * reach.norm(); });
  return outward < -0.05 * total ? -1.0F : 1.0F;
}

void turn_faces(Topology& topology) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (auto* of_corners : {&topology.corner_vertices, &topology.corner_uvs}) {
      if (of_corners->empty() || end - begin < 2) continue;
      std::reverse(of_corners->begin() + begin + 1, of_corners->begin() + end);
    }
  }
}

}  // namespace crowdface
