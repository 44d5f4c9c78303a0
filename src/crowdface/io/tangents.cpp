// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/tangents.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// Twice the signed area of a polygon in texture coordinates; 0 if a corner has no texture
/// coordinate.
double twice_uv_area(const Topology& topology, Index face, const TextureCoordinates& uvs) {
  const auto corners = topology.face_uvs(face);
  double area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::uint32_t a = corners[k], b = corners[(k + 1) % corners.size()];
    if (a == kNoIndex || b == kNoIndex) return 0;
    area += uvs(a, 0) * uvs(b, 1) - uvs(b, 0) * uvs(a, 1);
  }
  return area;
}

/// Projects a vector onto the plane of a unit normal and normalises the result; zero if the
/// projection vanishes.
Eigen::Vector3d in_plane(const Eigen::Vector3d& vector, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d flat = vector - normal * normal.dot(vector);
  const double length = flat.norm();
  return length > 0 ? Eigen::Vector3d(flat / length) : Eigen::Vector3d::Zero();
}

/// The arc cosine, rounded, because the last bits of acos differ between versions of the C library.
double angle_of(double cosine) {
  constexpr double kSteps = 1e9;
  return std::round(kSteps * std::acos(std::clamp(cosine, -1.0, 1.0))) / kSteps;
}

}  // namespace

SplitVertices split_at_mirrored_uvs(const Topology& topology, const TextureCoordinates& uvs) {
  const auto count = static_cast<std::uint32_t>(uvs.rows());
  Topology marked = topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (!(twice_uv_area(topology, f, uvs) < 0)) continue;
    const auto [begin, end] = topology.corners(f);
    for (std::uint32_t c = begin; c < end; ++c) marked.corner_uvs[c] += count;
  }
  SplitVertices split = split_vertices(marked);
  for (std::uint32_t& uv : split.uvs) {
    if (uv != kNoIndex && uv >= count) uv -= count;
  }
  return split;
}

Tangents::Tangents(const SplitVertices& split, const TextureCoordinates& uvs)
    : vertices_(split.vertices), signs_(split.vertices.size(), 1) {
  if (split.uvs.empty()) return;
  for (const std::array<std::uint32_t, 3>& corners : split.triangles) {
    std::array<Eigen::RowVector2d, 3> at;
    if (std::ranges::any_of(corners, [&](auto c) { return split.uvs[c] == kNoIndex; })) continue;
    for (std::size_t k = 0; k < 3; ++k) at[k] = uvs.row(split.uvs[corners[k]]);
    const Eigen::RowVector2d first = at[1] - at[0], second = at[2] - at[0];
    const double area = first.x() * second.y() - second.x() * first.y();
    if (!(std::abs(area) > 0)) continue;
    const double sign = area > 0 ? 1 : -1;
    triangles_.push_back({corners, sign * second.y(), -sign * first.y()});
    for (const std::uint32_t corner : corners) signs_[corner] = static_cast<float>(sign);
  }
}

void Tangents::write(char* out, const Positions& positions, const Positions& normals) const {
  Positions sums = Positions::Zero(static_cast<Index>(vertices_.size()), 3);
  for (const UvTriangle& triangle : triangles_) {
    std::array<Eigen::Vector3d, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = row3(positions, vertices_[triangle.corners[k]]);
    const Eigen::Vector3d along = triangle.first_edge_weight * (at[1] - at[0]) +
                                  triangle.second_edge_weight * (at[2] - at[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d normal = row3(normals, vertices_[triangle.corners[k]]);
      const Eigen::Vector3d to_next = in_plane(at[(k + 1) % 3] - at[k], normal),
                            to_last = in_plane(at[(k + 2) % 3] - at[k], normal);
      const double angle = angle_of(to_next.dot(to_last));
      sums.row(triangle.corners[k]) += angle * in_plane(along, normal).transpose();
    }
  }
  for (Index i = 0; i < sums.rows(); ++i) {
    const auto s = static_cast<std::size_t>(i);
    const Eigen::Vector3d normal = row3(normals, vertices_[s]);
    Eigen::Vector3d tangent = in_plane(row3(sums, i), normal);
    if (tangent.isZero()) tangent = normal.unitOrthogonal();  // no texture here
    sums.row(i) = tangent.transpose();
    out = put_number(put_row(out, sums, i), signs_[s]);
  }
}

std::size_t Tangents::memory_bytes() const {
  return vertices_.size() * sizeof(vertices_[0]) + signs_.size() * sizeof(signs_[0]) +
         triangles_.size() * sizeof(UvTriangle);
}

}  // namespace crowdface
