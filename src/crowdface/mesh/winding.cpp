// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/winding.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/normals.h"

namespace crowdface {
namespace {

constexpr Index kFacesPerBlock = 4096;

/// Flux of (position − middle) through the surface, as a fraction of the largest possible flux: 1
/// if all polygons face away from the middle, −1 if all polygons face towards it.
double outward_flux_fraction(const Topology& topology, const Positions& positions,
                             const Positions& areas, const Eigen::RowVector3d& middle) {
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
  return total > 0 ? outward / total : 0;
}

}  // namespace

float winding_sign(const Topology& topology, const Positions& positions) {
  constexpr double kMinInwardShare = 0.05;
  const Positions areas = face_area_vectors(topology, positions);
  return outward_flux_fraction(topology, positions, areas, positions.colwise().mean()) <
                 -kMinInwardShare
             ? -1.0F
             : 1.0F;
}

bool is_inside_out(const Topology& topology, const Positions& positions) {
  // Polygons clearly face inwards if outward_flux_fraction is below −kMinInwardShare. The fraction
  // is −1 for an inside-out sphere, and about −0.3 for an inside-out front of a head.
  constexpr double kMinInwardShare = 0.2;
  constexpr double kFlat = 0.8;  // |Σ area vectors| / Σ |area vectors|: 0 if closed, 1 if flat
  const Positions areas = face_area_vectors(topology, positions);
  Eigen::RowVector3d middle(0, 0, 0);
  double weight = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const double area = areas.row(f).norm();
    if (topology.face(f).empty() || !(area > 0)) continue;
    middle += area * positions.row(topology.face(f)[0]);
    weight += area;
  }
  if (!(areas.colwise().sum().norm() < kFlat * weight)) return false;
  return outward_flux_fraction(topology, positions, areas, middle / weight) < -kMinInwardShare;
}

void reverse_faces(Topology& topology) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (auto* of_corners : {&topology.corner_vertices, &topology.corner_uvs}) {
      if (of_corners->empty() || end - begin < 2) continue;
      std::reverse(of_corners->begin() + begin + 1, of_corners->begin() + end);
    }
  }
}

}  // namespace crowdface
