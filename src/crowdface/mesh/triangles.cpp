// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/triangles.h"

#include <Eigen/Geometry>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

template <class Wanted>
std::vector<Triangle> triangles_where(const Topology& topology, const Wanted& wanted) {
  std::vector<Triangle> triangles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (!wanted(face[0])) continue;
    for (std::size_t c = 1; c + 1 < face.size(); ++c) {
      triangles.push_back({face[0], face[c], face[c + 1]});
    }
  }
  return triangles;
}

}  // namespace

std::vector<Triangle> triangles_of(const Topology& topology) {
  return triangles_where(topology, [](std::uint32_t) { return true; });
}

std::vector<Triangle> triangles_of(const Topology& topology, const Components& components,
                                   std::uint32_t component) {
  return triangles_where(
      topology, [&](std::uint32_t v) { return components.component_of_vertex[v] == component; });
}

Topology topology_of(const std::vector<Triangle>& triangles, Index vertex_count) {
  Topology topology;
  topology.vertex_count = vertex_count;
  topology.corner_vertices.reserve(3 * triangles.size());
  topology.face_offsets.reserve(triangles.size() + 1);
  for (const Triangle& t : triangles) topology.add_face(t);
  return topology;
}

Eigen::Vector3d area_vector(const Positions& positions, const Triangle& triangle) {
  const Eigen::Vector3d a = row3(positions, triangle[0]);
  return (row3(positions, triangle[1]) - a).cross(row3(positions, triangle[2]) - a);
}

std::array<double, 3> nearest_in_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Positions vertex_normals_or_zero(const std::vector<Triangle>& triangles,
                                 const Positions& positions) {
  Positions normals = Positions::Zero(positions.rows(), 3);
  for (const Triangle& t : triangles) {
    const Eigen::RowVector3d area = area_vector(positions, t).transpose();
    for (const std::uint32_t v : t) normals.row(v) += area;
  }
  for (Index v = 0; v < normals.rows(); ++v)
    normals.row(v) = row3(normals, v).normalized().transpose();
  return normals;
}

}  // namespace crowdface
