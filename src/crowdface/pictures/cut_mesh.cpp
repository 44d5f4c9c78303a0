// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/cut_mesh.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace crowdface {
namespace {

/// Adds points on edges, at most one point per edge. The row of a point is interpolated between the
/// rows of the edge's two ends.
template <class Rows>
class EdgePoints {
 public:
  explicit EdgePoints(const Rows& rows) : rows_(rows) {}

  /// Returns the row in `all()` of the point at the fraction `share` of the edge. Adds the point if
  /// the edge has no point yet.
  std::uint32_t at(std::uint32_t from, std::uint32_t to, double share) {
    if (from > to) {  // both directions of an edge give the same bits
      std::swap(from, to);
      share = 1 - share;
    }
    const auto end =
        static_cast<std::uint32_t>(rows_.rows()) + static_cast<std::uint32_t>(points_.size());
    const auto [found, is_new] = known_.try_emplace({from, to}, end);
    if (is_new) points_.push_back((1 - share) * rows_.row(from) + share * rows_.row(to));
    return found->second;
  }
  /// The constructor's rows, followed by the new points.
  Rows all() const {
    Rows all(rows_.rows() + static_cast<Index>(points_.size()), rows_.cols());
    all.topRows(rows_.rows()) = rows_;
    Index at = rows_.rows();
    for (const auto& point : points_) all.row(at++) = point;
    return all;
  }

 private:
  const Rows& rows_;
  std::vector<Eigen::Matrix<double, 1, Rows::ColsAtCompileTime>> points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_;
};

}  // namespace

Mesh cut_mesh(const Mesh& mesh, std::span<const double> signed_distances) {
  Topology part;
  EdgePoints points(mesh.positions);
  EdgePoints uv_points(mesh.uvs);
  const bool has_uvs = !mesh.topology.corner_uvs.empty() && mesh.uvs.rows() > 0;
  for (Index f = 0; f < mesh.topology.face_count(); ++f) {
    const auto face = mesh.topology.face(f), face_uvs = mesh.topology.face_uvs(f);
    std::vector<std::uint32_t> corners, uvs;
    for (std::size_t c = 0; c < face.size(); ++c) {
      const std::size_t next = (c + 1) % face.size();
      const double here = signed_distances[face[c]], there = signed_distances[face[next]];
      if (here >= 0) {
        corners.push_back(face[c]);
        if (has_uvs) uvs.push_back(face_uvs[c]);
      }
      if ((here >= 0) == (there >= 0)) continue;
      const double share = here / (here - there);
      corners.push_back(points.at(face[c], face[next], share));
      if (!has_uvs) continue;
      const bool placed = face_uvs[c] != kNoIndex && face_uvs[next] != kNoIndex;
      uvs.push_back(placed ? uv_points.at(face_uvs[c], face_uvs[next], share) : kNoIndex);
    }
    if (corners.size() > 2) part.add_face(corners, uvs);
  }
  Positions positions = points.all();
  part.vertex_count = positions.rows();
  return {std::move(part), std::move(positions), uv_points.all()};
}

}  // namespace crowdface
