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
  // Relative to the first corner, so that a mesh far from the origin loses no digits.
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
  parallel_blocks(areas.rows(), kRowsPerBlock, [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f) areas.row(f) = face_area_vector(topology, f, positions);
  });
  return areas;
}

NormalFans::NormalFans(const Topology& topology)
    : NormalFans(topology, topology.corner_vertices, topology.vertex_count) {}

NormalFans::NormalFans(const Topology& topology, std::span<const std::uint32_t> corner_rows,
                       Index rows)
    : offsets_(static_cast<std::size_t>(rows) + 1) {
  for (const std::uint32_t row : corner_rows) {
    if (row != kNoIndex) ++offsets_[row + 1];
  }
  for (std::size_t row = 1; row < offsets_.size(); ++row) offsets_[row] += offsets_[row - 1];
  faces_.resize(offsets_.back());
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t f = 0; f + 1 < topology.face_offsets.size(); ++f) {
    for (auto c = topology.face_offsets[f]; c < topology.face_offsets[f + 1]; ++c) {
      const std::uint32_t row = corner_rows[c];
      if (row != kNoIndex) faces_[next[row]++] = static_cast<std::uint32_t>(f);
    }
  }
}

Positions NormalFans::normals(const Topology& topology, const Positions& positions,
                              const Eigen::RowVector3d& nowhere) const {
  return normals(face_area_vectors(topology, positions), nowhere);
}

Positions NormalFans::normals(const Positions& areas, const Eigen::RowVector3d& nowhere) const {
  Positions normals(rows(), 3);
  parallel_blocks(rows(), kRowsPerBlock, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      for (const std::uint32_t face : around(row)) sum += areas.row(face);
      const double length = std::sqrt(sum(0) * sum(0) + sum(1) * sum(1) + sum(2) * sum(2));
      normals.row(row) = length > 0 ? Eigen::RowVector3d(sum / length) : nowhere;
    }
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
