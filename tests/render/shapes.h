// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A sphere of quads around the origin, triangles at the poles on ±Y.
inline Mesh make_sphere(double radius, std::uint32_t rings = 24, std::uint32_t sectors = 48) {
  Mesh mesh;
  mesh.topology.vertex_count = 2 + Index{rings - 1} * sectors;
  mesh.positions.resize(mesh.topology.vertex_count, 3);
  mesh.positions.row(0) << 0, radius, 0;
  mesh.positions.row(1) << 0, -radius, 0;
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
    if (ring == 0) return 0U;
    if (ring == rings) return 1U;
    return 2 + (ring - 1) * sectors + sector % sectors;
  };
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const double polar = std::numbers::pi * ring / rings;
      const double around = 2 * std::numbers::pi * sector / sectors;
      mesh.positions.row(at(ring, sector)) << radius * std::sin(polar) * std::sin(around),
          radius * std::cos(polar), radius * std::sin(polar) * std::cos(around);
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      std::vector<std::uint32_t> face = {at(ring, sector), at(ring + 1, sector),
                                         at(ring + 1, sector + 1), at(ring, sector + 1)};
      if (ring == 0) face.pop_back();
      if (ring + 1 == rings) face.erase(face.begin() + 2);
      mesh.topology.corner_vertices.insert(mesh.topology.corner_vertices.end(), face.begin(),
                                           face.end());
      mesh.topology.face_offsets.push_back(
          static_cast<std::uint32_t>(mesh.topology.corner_vertices.size()));
    }
  }
  return mesh;
}

/// Both meshes in one, the second moved.
inline Mesh join_meshes(const Mesh& first, const Mesh& second, const Eigen::RowVector3d& move) {
  Mesh mesh = first;
  const auto vertices = static_cast<std::uint32_t>(first.topology.vertex_count);
  const std::uint32_t corners = first.topology.face_offsets.back();
  for (const std::uint32_t vertex : second.topology.corner_vertices) {
    mesh.topology.corner_vertices.push_back(vertex + vertices);
  }
  for (std::size_t f = 1; f < second.topology.face_offsets.size(); ++f) {
    mesh.topology.face_offsets.push_back(second.topology.face_offsets[f] + corners);
  }
  mesh.topology.vertex_count += second.topology.vertex_count;
  mesh.positions.conservativeResize(mesh.topology.vertex_count, 3);
  mesh.positions.bottomRows(second.positions.rows()) = second.positions.rowwise() + move;
  return mesh;
}

}  // namespace crowdface
