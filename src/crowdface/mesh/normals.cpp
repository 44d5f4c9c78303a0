// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/normals.h"

#include <cmath>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr Index kRowsPerBlock = 8192;

}  // namespace

Eigen::Vector3d face_area_vector(const Topology& topology, Index face, const Positions& positions) {
  const auto vertices = topology.face(face);
  // Coordinates are relative to the first corner, so that a mesh far from the origin loses no
  // precision.
  const Eigen::Vector3d origin = positions.row(vertices[0]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t c = 1; c + 1 < vertices.size(); ++c) {
    const Eigen::Vector3d a = positions.row(vertices[c]).transpose() - origin;
    const Eigen::Vector3d b = positions.row(vertices[c + 1]).transpose() - origin;
    sum += a.cross(b);
  }
  return sum;
}

Positions face_area_vectors(const Topology& topology, const Positions& positions) {
  Positions areas(topology.face_count(), 3);
  parallel_for_each(areas.rows(), kRowsPerBlock,
                    [&](Index f) { areas.row(f) = face_area_vector(topology, f, positions); });
  return areas;
}

NormalFans::NormalFans(const Topology& topology) : polygons_of_normal_(VertexFaces(topology)) {}

NormalFans::NormalFans(const Topology& topology, std::span<const std::uint32_t> normal_of_corner,
                       Index count)
    : polygons_of_normal_(
          compressed_rows<std::uint32_t>(static_cast<std::size_t>(count), [&](const auto& put) {
            for (Index f = 0; f < topology.face_count(); ++f) {
              const auto [begin, end] = topology.corners(f);
              for (auto c = begin; c < end; ++c) {
                const std::uint32_t normal = normal_of_corner[c];
                if (normal != kNoIndex) put(normal, static_cast<std::uint32_t>(f));
              }
            }
          })) {}

Positions NormalFans::normals(const Topology& topology, const Positions& positions,
                              const Eigen::RowVector3d& fallback) const {
  return normals(face_area_vectors(topology, positions), fallback);
}

Positions NormalFans::normals(const Positions& areas, const Eigen::RowVector3d& fallback) const {
  Positions normals(rows(), 3);
  parallel_for_each(rows(), kRowsPerBlock, [&](Index row) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const std::uint32_t face : polygons_at(row)) sum += areas.row(face);
    const double length = std::sqrt(sum(0) * sum(0) + sum(1) * sum(1) + sum(2) * sum(2));
    normals.row(row) = length > 0 ? Eigen::RowVector3d(sum / length) : fallback;
  });
  return normals;
}

Positions vertex_normals(const Topology& topology, const Positions& positions) {
  return vertex_normals(NormalFans(topology), topology, positions);
}

Positions vertex_normals(const NormalFans& fans, const Topology& topology,
                         const Positions& positions) {
  return fans.normals(topology, positions, {0, 0, 1});
}

}  // namespace crowdface
