// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/makehuman_grooming.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/core/interpolate_knots.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/render/ray_scene.h"

namespace crowdface {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kParting = 46;  // where the swept hair begins, in degrees

/// Finds the outermost point of a mesh on a line.
class OuterSurface {
 public:
  explicit OuterSurface(const Mesh& mesh)
      : quads_(quads_of(triangles_of(mesh.topology))),
        scene_(device_, points_around(mesh.positions, Vector3d::Zero()), quads_) {}

  /// Returns the largest t at which the line origin + t · direction meets the mesh.
  /// \param direction  of length 1
  std::optional<double> outermost(const Vector3d& origin, const Vector3d& direction) const {
    constexpr double kOutside = 60;  // centimetres; no hair is so far from the head's axis
    const Vector3d start = origin + kOutside * direction, inwards = -direction;
    const Ray ray{start.cast<float>(), inwards.cast<float>()};
    const auto hit = scene_.nearest_hits(std::span(&ray, 1)).front();
    return hit ? std::optional(kOutside - double{hit->distance}) : std::nullopt;
  }

 private:
  RayDevice device_;
  std::vector<Quad> quads_;
  RayScene scene_;
};

/// A position in cylindrical coordinates around the head's vertical axis.
struct RoundTheHead {
  static constexpr double kAxisZ = -6;  // z of the axis, in centimetres
  double degrees;         ///< angle: 0 to the front, negative on the right side (x < 0)
  double height, radius;  ///< height along the axis and distance from the axis, in centimetres

  static RoundTheHead of(const Vector3d& p) {
    return {std::atan2(p.x(), p.z() - kAxisZ) / kDegree, p.y(), std::hypot(p.x(), p.z() - kAxisZ)};
  }
  Vector3d origin() const { return {0, height, kAxisZ}; }
  Vector3d direction() const {
    return {std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree)};
  }
  Vector3d position() const { return origin() + radius * direction(); }
};

/// For each height, the range of angles in front of the face in which there is no hair.
struct FreeRange {
  /// The begin and the end of the range at each height. Each element of the two lists is a pair
  /// (height, angle in degrees). The heights ascend and are the same in both lists.
  std::vector<Vector2d> begin, end;
};

/// Finds, at each height, the widest range of angles in which the hair mesh has no vertices. At
/// heights where hair covers the whole face, the range is empty: its begin and its end are both the
/// angle of the parting.
FreeRange range_without_hair(const Positions& hair) {
  constexpr double kLowest = -20, kHighest = 7, kRow = 0.5;
  constexpr double kSide = 75;      // the sides of the face, in degrees
  constexpr double kNarrowest = 6;  // smaller gaps lie between strands
  FreeRange free;
  for (int row = 0; kLowest + row * kRow <= kHighest; ++row) {
    const double height = kLowest + row * kRow;
    std::vector<double> angles = {-kSide, kSide};
    for (Index v = 0; v < hair.rows(); ++v) {
      const auto place = RoundTheHead::of(hair.row(v));
      const bool near = std::abs(place.height - height) < 1.5 * kRow;
      if (near && std::abs(place.degrees) < kSide) angles.push_back(place.degrees);
    }
    std::ranges::sort(angles);
    double begin = kParting, end = kParting;
    for (std::size_t k = 1; k < angles.size(); ++k) {
      if (angles[k] - angles[k - 1] > std::max(kNarrowest, end - begin)) {
        begin = angles[k - 1];
        end = angles[k];
      }
    }
    free.begin.push_back({height, begin});
    free.end.push_back({height, end});
  }
  return free;
}

}  // namespace

Positions combed_aside(const Positions& hair, const Mesh& head) {
  constexpr double kBehind = -70;  // where hair stays in place, in degrees
  // Pairs (height in centimetres, angle in degrees; see RoundTheHead). At each height, hair that is
  // combed aside reaches from the right side of the head to this angle at most; angles between the
  // heights are interpolated. At the height of the eyes, the hair must end behind the brow. On the
  // upper forehead, the hair may reach the parting.
  const std::array<Vector2d, 4> allowed = {
      Vector2d{1.6, -42}, {3, -25}, {4.5, 10}, {6.5, kParting}};
  const FreeRange free = range_without_hair(hair);
  if (interpolate_knots(free.begin, 0) <= interpolate_knots(allowed, 0)) return hair;
  const OuterSurface surface(head);
  Positions combed = hair;
  for (Index v = 0; v < hair.rows(); ++v) {
    const auto before = RoundTheHead::of(hair.row(v));
    const double begin = interpolate_knots(free.begin, before.height);
    const double end = interpolate_knots(free.end, before.height);
    const double target = std::min(begin, interpolate_knots(allowed, before.height));
    if (begin <= target || before.degrees <= kBehind || before.degrees >= end) continue;
    RoundTheHead after = before;
    after.degrees =
        before.degrees <= begin
            ? kBehind + (before.degrees - kBehind) * (target - kBehind) / (begin - kBehind)
            : target + (before.degrees - begin) * (end - target) / (end - begin);
    const auto skin_before = surface.outermost(before.origin(), before.direction());
    const auto skin_after = surface.outermost(after.origin(), after.direction());
    if (skin_before && skin_after) {
      constexpr double kGap = 0.3;
      const double gap = before.radius - *skin_before;
      after.radius = *skin_after + (gap > 0 ? std::max(gap, kGap) : gap);
    }
    combed.row(v) = after.position();
  }
  return combed;
}

Positions levelled_brows(const Positions& brows, const Mesh& head) {
  constexpr double kSteepest = 3;  // degrees
  constexpr double kRise = 0.15;   // centimetres
  const OuterSurface surface(head);
  const auto front = [&](double x, double y) {
    return surface.outermost({x, y, 0}, Vector3d::UnitZ());
  };
  Positions level = brows;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Index> rows;
    for (Index v = 0; v < brows.rows(); ++v) {
      if (side * brows(v, 0) > 0) rows.push_back(v);
    }
    if (rows.empty()) continue;
    // Fit the slope of the brow's inner two thirds by least squares. The outer third falls again.
    std::ranges::sort(rows, {}, [&](Index v) { return std::abs(brows(v, 0)); });
    const std::vector<Index> inner(rows.begin(),
                                   rows.begin() + std::ptrdiff_t(rows.size() + 2) * 2 / 3);
    const Eigen::VectorXd x = side * brows(inner, 0), y = brows(inner, 1);
    const Eigen::VectorXd from_mean = x.array() - x.mean();
    const double slope =
        from_mean.squaredNorm() == 0 ? 0 : from_mean.dot(y) / from_mean.squaredNorm();
    const double turn = side * std::min(0.0, kSteepest * kDegree - std::atan(slope));
    const Eigen::Rotation2Dd rotation(turn);
    const Positions all = brows(rows, kAllColumns);
    const Vector2d centre(all.col(0).mean(), all.col(1).mean());
    for (const Index v : rows) {
      const Vector2d before(brows(v, 0), brows(v, 1));
      const Vector2d after = centre + rotation * (before - centre) + Vector2d(0, kRise);
      const auto skin_before = front(before.x(), before.y()),
                 skin_after = front(after.x(), after.y());
      level.row(v).head<2>() = after;
      if (skin_before && skin_after) level(v, 2) += *skin_after - *skin_before;
    }
  }
  return level;
}

Mesh with_cap(const Mesh& hair, const Mesh& head, Index skin_faces, const Eigen::RowVector2d& uv) {
  constexpr double kLowest = -6;       // the cap ends above the neck
  constexpr double kThickness = 0.05;  // centimetres
  const Positions normals = vertex_normals(head.topology, head.positions);
  const OuterSurface surface(hair);
  std::vector<bool> covered(static_cast<std::size_t>(head.positions.rows()), false);
  for (Index v = 0; v < head.positions.rows(); ++v) {
    if (head.positions(v, 1) < kLowest) continue;
    const auto distance = surface.outermost(head.positions.row(v), normals.row(v));
    covered[static_cast<std::size_t>(v)] = distance && *distance > kThickness;
  }
  // Gives `value` to the neighbours of all vertices that have this value.
  const auto spread = [&](bool value) {
    std::vector<bool> wider = covered;
    for (Index f = 0; f < skin_faces; ++f) {
      const auto corners = head.topology.face(f);
      if (std::ranges::none_of(corners, [&](std::uint32_t v) { return covered[v] == value; })) {
        continue;
      }
      for (const std::uint32_t v : corners) wider[v] = value;
    }
    covered = std::move(wider);
  };
  // Grow the covered area by kGrowth rows of vertices, then shrink it by the same number of rows.
  // This closes slits with up to 2 · kGrowth rows of uncovered vertices. Shrink by one more row, to
  // keep the cap away from the edge of the hair.
  constexpr int kGrowth = 2;
  for (int i = 0; i < kGrowth; ++i) spread(true);
  for (int i = 0; i < kGrowth + 1; ++i) spread(false);
  Mesh capped = hair;
  std::vector<std::uint32_t> rows(covered.size(), kNoIndex);
  std::vector<Eigen::RowVector3d> added;
  const auto corner_uv = static_cast<std::uint32_t>(hair.uvs.rows());
  for (Index f = 0; f < skin_faces; ++f) {
    const auto corners = head.topology.face(f);
    if (!std::ranges::all_of(corners, [&](std::uint32_t v) { return covered[v]; })) continue;
    std::vector<std::uint32_t> of_cap;
    for (const std::uint32_t v : corners) {
      if (rows[v] == kNoIndex) {
        rows[v] = static_cast<std::uint32_t>(hair.positions.rows()) +
                  static_cast<std::uint32_t>(added.size());
        added.push_back(head.positions.row(v) + kThickness * normals.row(v));
      }
      of_cap.push_back(rows[v]);
    }
    capped.topology.add_face(of_cap, std::vector(of_cap.size(), corner_uv));
  }
  capped.positions.conservativeResize(hair.positions.rows() + static_cast<Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i) {
    capped.positions.row(hair.positions.rows() + static_cast<Index>(i)) = added[i];
  }
  capped.topology.vertex_count = capped.positions.rows();
  capped.uvs.conservativeResize(hair.uvs.rows() + 1, 2);
  capped.uvs.bottomRows(1) = uv;
  return capped;
}

Mesh cut_below(const Mesh& hair, double height) {
  Mesh cut;
  for (Index f = 0; f < hair.topology.face_count(); ++f) {
    const auto corners = hair.topology.face(f);
    const bool removed = std::ranges::all_of(
        corners, [&](std::uint32_t v) { return hair.positions(v, 1) < height; });
    if (!removed) cut.topology.add_face(corners, hair.topology.face_uvs(f));
  }
  const auto rows = renumber(cut.topology.corner_vertices, hair.positions.rows());
  const auto uv_rows = renumber(cut.topology.corner_uvs, hair.uvs.rows());
  cut.topology.vertex_count = static_cast<Index>(rows.size());
  cut.positions = hair.positions(rows, kAllColumns);
  cut.positions.col(1) = cut.positions.col(1).cwiseMax(height);
  cut.uvs = hair.uvs(uv_rows, kAllColumns);
  return cut;
}

Mesh mirrored(const Mesh& mesh) {
  Mesh other{{}, mesh.positions, mesh.uvs};
  other.positions.col(0) *= -1;
  // Reverse the order of corners, so that the mirrored polygons face outwards again.
  for (Index f = 0; f < mesh.topology.face_count(); ++f) {
    const auto corners = mesh.topology.face(f), uvs = mesh.topology.face_uvs(f);
    other.topology.add_face(std::vector(corners.rbegin(), corners.rend()),
                            std::vector(uvs.rbegin(), uvs.rend()));
  }
  other.topology.vertex_count = mesh.topology.vertex_count;
  return other;
}

}  // namespace crowdface
