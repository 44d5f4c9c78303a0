// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/mirror_map.h"

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr Index kRows = 4096;  ///< number of vertices that each parallel task processes

}  // namespace

Eigen::Vector3d MirrorPlane::mirrored(const Eigen::Vector3d& point) const {
  return point - 2 * (normal.dot(point) - offset) * normal;
}

Positions mirrored(const MirrorMap& map, const Positions& positions) {
  Positions image(positions.rows(), 3);
  parallel_for_each(positions.rows(), kRows, [&](Index v) {
    const auto i = static_cast<std::size_t>(v);
    Eigen::Vector3d place = map.barycentric[i][0] * positions.row(map.corners[i][0]).transpose();
    if (!map.has_mirror_vertex(static_cast<std::uint32_t>(v))) {
      for (std::size_t c = 1; c < 3; ++c) {
        place += map.barycentric[i][c] * positions.row(map.corners[i][c]).transpose();
      }
    }
    image.row(v) = map.plane.mirrored(place).transpose();
  });
  for (std::size_t i = 0; i < map.unpaired_vertices.size(); ++i) {
    image.row(map.unpaired_vertices[i]) += map.unpaired_offsets.row(static_cast<Index>(i));
  }
  return image;
}

Positions blend_with_mirrored(const Positions& positions, const Positions& image, double w) {
  Positions result(positions.rows(), 3);
  // The result is (1 − w) · positions + w · image. Start the interpolation at the input with the
  // larger weight, so that w = 0 gives exactly `positions` and w = 1 gives exactly `image`.
  const bool near_image = w > 0.5;
  const Positions& from = near_image ? image : positions;
  const Positions& to = near_image ? positions : image;
  const double share = near_image ? 1 - w : w;
  parallel_for_each(positions.rows(), kRows, [&](Index v) {
    for (Index c = 0; c < 3; ++c) result(v, c) = from(v, c) + share * (to(v, c) - from(v, c));
  });
  return result;
}

double mirror_image_weight(double asymmetry, bool mirrored) {
  return (mirrored ? 1 + asymmetry : 1 - asymmetry) / 2;
}

}  // namespace crowdface
