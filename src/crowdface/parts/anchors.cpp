// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/anchors.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

/// Returns the vertices, ascending, of all polygons that contain at least one of the corners.
std::vector<std::uint32_t> ring_of(const Topology& topology, const VertexFaces& faces,
                                   const std::array<std::uint32_t, 3>& corners) {
  std::vector<std::uint32_t> ring;
  for (const std::uint32_t corner : corners) {
    for (const std::uint32_t f : faces.items_of(corner)) {
      ring.insert(ring.end(), topology.face(f).begin(), topology.face(f).end());
    }
  }
  std::ranges::sort(ring);
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

}  // namespace

Anchors::Anchors(const Topology& topology, const VertexFaces& faces, const Positions& positions,
                 const PointGrid& skin, std::vector<std::uint32_t> vertices_to_bind)
    : bound_vertices_(std::move(vertices_to_bind)) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  for (const std::uint32_t v : bound_vertices_) {
    const Eigen::Vector3d point = positions.row(v).transpose();
    const SurfacePoint place =
        nearest_point_around(topology, faces, positions, skin.nearest(point).vertex, point);
    const auto [entry, is_new] =
        known.emplace(place.corners, static_cast<std::uint32_t>(skin_triangles_.size()));
    triangle_indices_.push_back(entry->second);
    barycentric_.push_back(place.barycentric);
    if (!is_new) continue;
    const std::vector<std::uint32_t> ring = ring_of(topology, faces, place.corners);
    const Eigen::Vector3d middle = centre_of(positions, ring);
    const Eigen::Vector3d along =
        (row3(positions, place.corners[1]) - row3(positions, place.corners[0])).normalized();
    const Eigen::Vector3d across = normal_at(positions, place).cross(along);
    std::vector<RingVertex> weighted;
    for (const std::uint32_t r : ring) {
      const Eigen::Vector3d from = row3(positions, r) - middle;
      weighted.push_back({r, from.dot(along), from.dot(across)});
    }
    rings_.add_group(weighted);
    skin_triangles_.push_back(place.corners);
  }
}

Anchors::Frame Anchors::frame_at(std::size_t triangle_index, const Positions& positions) const {
  // Positions are relative to the first corner, so that rounding does not depend on the head's
  // position.
  const Eigen::Vector3d first = row3(positions, skin_triangles_[triangle_index][0]);
  Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = along;
  for (const RingVertex& ring : rings_.items_of(triangle_index)) {
    const Eigen::Vector3d from = row3(positions, ring.vertex) - first;
    along += ring.first_axis_weight * from;
    across += ring.second_axis_weight * from;
  }
  const Eigen::Vector3d x = along.normalized(), z = x.cross(across).normalized();
  return {x, z.cross(x), z};
}

Eigen::Vector3d Anchors::origin(std::size_t i, const Positions& positions) const {
  return point_on(positions, skin_triangles_[triangle_indices_[i]], barycentric_[i]);
}

bool Anchors::is_unmoved(std::size_t triangle_index, const Positions& before,
                         const Positions& after) const {
  return std::ranges::all_of(rings_.items_of(triangle_index), [&](const RingVertex& ring) {
    return before.row(ring.vertex) == after.row(ring.vertex);
  });
}

std::vector<Eigen::Vector3d> Anchors::measure_offsets(const Positions& head) const {
  std::vector<Frame> frames;
  for (std::size_t s = 0; s < skin_triangles_.size(); ++s) frames.push_back(frame_at(s, head));
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < bound_vertices_.size(); ++i) {
    const Eigen::Vector3d offset = head.row(bound_vertices_[i]).transpose() - origin(i, head);
    const Frame& frame = frames[triangle_indices_[i]];
    result.emplace_back(offset.dot(frame[0]), offset.dot(frame[1]), offset.dot(frame[2]));
  }
  return result;
}

void Anchors::place_vertices(const Positions& target, std::span<const Eigen::Vector3d> offsets,
                             Positions& result) const {
  std::vector<Frame> frames;
  std::vector<bool> still;
  for (std::size_t s = 0; s < skin_triangles_.size(); ++s) {
    still.push_back(is_unmoved(s, target, result));
    frames.push_back(still.back() ? Frame{} : frame_at(s, result));
  }
  for (std::size_t i = 0; i < bound_vertices_.size(); ++i) {
    const std::uint32_t v = bound_vertices_[i];
    if (still[triangle_indices_[i]]) {
      result.row(v) = target.row(v);
      continue;
    }
    const Frame& frame = frames[triangle_indices_[i]];
    const Eigen::Vector3d offset =
        offsets[i].x() * frame[0] + offsets[i].y() * frame[1] + offsets[i].z() * frame[2];
    result.row(v) = (origin(i, result) + offset).transpose();
  }
}

PartWeights::PartWeights(const Positions& positions,
                         const std::vector<std::span<const std::uint32_t>>& rigid,
                         std::span<const std::uint32_t> bound, double reach) {
  std::vector<PointGrid> grids;
  grids.reserve(rigid.size());
  for (const auto& vertices : rigid) grids.emplace_back(positions, vertices);
  for (const std::uint32_t v : bound) {
    const std::size_t first = weights_.size();
    double sum = 0;
    for (std::uint32_t part = 0; part < grids.size(); ++part) {
      const auto nearest = grids[part].nearest(positions.row(v).transpose(), reach);
      if (nearest.vertex == kNoIndex) continue;
      const double weight = biweight(nearest.distance / reach);
      weights_.push_back({v, part, weight});
      sum += weight;
    }
    // Scale the vertex's weights to a sum of at most one, so that a vertex between two parts
    // follows both parts.
    for (std::size_t i = first; i < weights_.size(); ++i) weights_[i].weight /= std::max(1.0, sum);
  }
}

void PartWeights::move_with_parts(const Positions& target, std::span<const RigidMotion> motions,
                                  Positions& result) const {
  for (std::size_t i = 0; i < weights_.size();) {
    const std::uint32_t v = weights_[i].vertex;
    const Eigen::Vector3d bound = result.row(v).transpose();
    Eigen::Vector3d change = Eigen::Vector3d::Zero();
    for (; i < weights_.size() && weights_[i].vertex == v; ++i) {
      const auto& [vertex, part, weight] = weights_[i];
      change += weight * (motions[part].apply(target.row(v).transpose()) - bound);
    }
    result.row(v) = (bound + change).transpose();
  }
}

}  // namespace crowdface
