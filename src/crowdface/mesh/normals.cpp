// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/normals.h"

#include <cmath>

#include <Eigen/Geometry>

namespace crowdface {

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

Positions vertex_normals(const Topology& topology, const Positions& positions) {
  Positions normals = Positions::Zero(topology.vertex_count, 3);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Eigen::RowVector3d area = face_area_vector(topology, f, positions);
    for (const std::uint32_t vertex : topology.face(f)) normals.row(vertex) += area;
  }
  for (Index i = 0; i < normals.rows(); ++i) {
    const double length = std::sqrt(normals(i, 0) * normals(i, 0) + normals(i, 1) * normals(i, 1) +
                                    normals(i, 2) * normals(i, 2));
    if (length > 0) {
      normals.row(i) /= length;
    } else {
      normals.row(i) = Eigen::RowVector3d(0, 0, 1);
    }
  }
  return normals;
}

}  // namespace crowdface
