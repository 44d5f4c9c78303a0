// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/skin_over_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

// Lengths are fractions of the skin's extent, about 430 mm. kDepth: target depth of a covered
// vertex below the skin. If the vertex is less deep on the template, the depth on the template is
// the target.
constexpr double kDepth = 0.001;
constexpr double kFrontReach = 0.025;  // largest depth of a covered vertex on the template
// Vertices of gums and teeth need a check only if their distance behind the skin is at most this
// fraction of the skin's extent.
constexpr double kNear = 0.008;
constexpr double kPushedAround = 0.02;  // radius of the skin that a push moves
// Only one vertex in each grid cell is checked. Size of a cell, as a fraction of the skin's extent.
constexpr double kFrontCell = 0.0025;
// A covered vertex should lie at CoveredVertex::depth below the skin. The skin in front of the
// vertex is pushed only if the vertex lies at less than this fraction of that depth.
constexpr double kTooNear = 0.25;
// Only skin that faces the front covers vertices: smallest cosine between the skin's normal and the
// head's front axis. Excludes the rims of the lips.
constexpr double kMinFrontCosine = 0.5;
/// On a face, the triangle in front of a vertex may differ from the template's covering triangle.
/// Candidates are the covering triangle and several rings of triangles around it. The number of
/// rings is kMaxSlide (a fraction of the skin's extent, about 3 mm) divided by the mean edge
/// length, but at least kMinRings and at most kMaxRings.
constexpr double kMinRings = 2, kMaxRings = 12;
constexpr double kMaxSlide = 0.007;
constexpr int kFrontRounds = 6;

Eigen::Vector3d normal_of(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

/// Returns the distance by which a triangle is in front of a point (negative: behind). Returns
/// nothing if the triangle does not overlap the point, seen from the front.
std::optional<double> ahead_of(const Eigen::Vector3d& point, const Corners& corners,
                               const HeadAxes& axes, const Eigen::Vector3d& side) {
  std::array<double, 3> x{}, y{}, shares{};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = (corners[k] - point).dot(side);
    y[k] = (corners[k] - point).dot(axes.up);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    shares[k] = x[a] * y[b] - y[a] * x[b];
  }
  const auto [least, most] = std::ranges::minmax(shares);
  if (least == most || (least < 0 && most > 0)) return std::nullopt;
  double ahead = 0;
  for (std::size_t k = 0; k < 3; ++k) ahead += shares[k] * (corners[k] - point).dot(axes.front);
  return ahead / (shares[0] + shares[1] + shares[2]);
}

/// The triangles of the skin in a grid, as seen from the front. Finds the foremost triangle that
/// overlaps a point.
class FrontView {
 public:
  FrontView(const Positions& positions, std::span<const Triangle> triangles, const HeadAxes& axes,
            double cell)
      : positions_(positions), triangles_(triangles), axes_(axes), side_(axes.side()), cell_(cell) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      Eigen::AlignedBox2d box;
      for (const std::uint32_t v : triangles[t]) box.extend(seen(row3(positions, v)));
      const auto [left, bottom] = cell_of(box.min());
      const auto [right, top] = cell_of(box.max());
      for (std::int64_t x = left; x <= right; ++x) {
        for (std::int64_t y = bottom; y <= top; ++y) cells_[{x, y}].push_back(t);
      }
    }
  }

  struct Hit {
    std::uint32_t triangle;
    double ahead;  ///< distance by which the triangle is in front of the point
  };
  /// Returns the foremost of the triangles that overlap a point, seen from the front. The triangle
  /// may lie behind the point.
  std::optional<Hit> foremost(const Eigen::Vector3d& point) const {
    const auto cell = cells_.find(cell_of(seen(point)));
    if (cell == cells_.end()) return std::nullopt;
    std::optional<Hit> best;
    for (const std::uint32_t t : cell->second) {
      const auto ahead = ahead_of(point, corners_of(positions_, triangles_[t]), axes_, side_);
      if (ahead && (!best || *ahead > best->ahead)) best = Hit{t, *ahead};
    }
    return best;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;

  Eigen::Vector2d seen(const Eigen::Vector3d& point) const {
    return {point.dot(side_), point.dot(axes_.up)};
  }
  Cell cell_of(const Eigen::Vector2d& at) const {
    return {static_cast<std::int64_t>(std::floor(at.x() / cell_)),
            static_cast<std::int64_t>(std::floor(at.y() / cell_))};
  }

  const Positions& positions_;
  std::span<const Triangle> triangles_;
  HeadAxes axes_;
  Eigen::Vector3d side_;
  double cell_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace

SkinOverParts::SkinOverParts(const Positions& shaped, const SkinTriangles& skin,
                             std::span<const std::uint32_t> inner,
                             std::span<const std::uint32_t> moved, const HeadAxes& axes,
                             double extent)
    : axes_(axes), extent_(extent) {
  if (inner.empty()) return;
  Eigen::AlignedBox3d box = bounding_box(shaped, inner);
  box = {box.min().array() - kFrontReach * extent, box.max().array() + kFrontReach * extent};
  std::vector<std::uint32_t> numbers;
  std::vector<Triangle> around;
  for (std::uint32_t t = 0; t < skin.triangles.size(); ++t) {
    if (!box.contains(row3(shaped, skin.triangles[t][0]))) continue;
    numbers.push_back(t);
    around.push_back(skin.triangles[t]);
  }
  const auto is_moved = [&](std::uint32_t v) { return std::ranges::binary_search(moved, v); };
  if (std::ranges::none_of(around,
                           [&](const Triangle& t) { return std::ranges::any_of(t, is_moved); })) {
    return;
  }
  double area = 0;
  for (const Triangle& t : around) area += area_vector(shaped, t).norm();
  const double edge =
      std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, around.size())));
  const int rings = static_cast<int>(std::clamp(kMaxSlide * extent / edge, kMinRings, kMaxRings));
  const FrontView view(shaped, around, axes, kFrontReach * extent / 4);
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> taken;
  // Find the vertices that the skin covers on the template with the blend shape applied. Take at
  // most one vertex from each cell of a grid, so that the vertices are spread evenly.
  for (const std::uint32_t v : inner) {
    const Eigen::Vector3d point = row3(shaped, v);
    const auto cell = [&](Index c) {
      return static_cast<std::int64_t>(std::floor(point[c] / (kFrontCell * extent)));
    };
    const std::tuple at{cell(0), cell(1), cell(2)};
    if (taken.contains(at)) continue;
    const auto hit = view.foremost(point);
    if (!hit || hit->ahead <= 0) continue;
    const double facing = axes.front.dot(normal_of(corners_of(shaped, around[hit->triangle])));
    const double depth = hit->ahead * facing;
    if (facing < kMinFrontCosine || depth > kFrontReach * extent) continue;
    if (std::ranges::none_of(around[hit->triangle], is_moved)) continue;
    taken.insert(at);
    // On a face, another triangle of the skin may be in front of this vertex. Collect the
    // candidates: `rings` rings of triangles around the triangle that was hit on the template.
    std::vector<std::uint32_t> near = {numbers[hit->triangle]};
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<std::uint32_t> wider;
      for (const std::uint32_t t : near) {
        for (const std::uint32_t corner : skin.triangles[t]) {
          const auto of = skin.vertex_triangles.items_of(corner);
          wider.insert(wider.end(), of.begin(), of.end());
        }
      }
      std::ranges::sort(wider);
      wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
      near = std::move(wider);
    }
    CoveredVertex covered{v, around[hit->triangle], {}, std::min(depth, kDepth * extent)};
    for (const std::uint32_t t : near) covered.candidates.push_back(skin.triangles[t]);
    covered_vertices_.push_back(std::move(covered));
  }
}

void SkinOverParts::keep_in_front(const Positions& rest, const RigidMotion& face_motion,
                                  std::span<const DisplacementRow> rows, Positions& mesh,
                                  Displacements& shape) const {
  shape.add_to(mesh);
  // For each covered vertex: a limit for the sum of the distances by which the vertex pushes skin
  // forward in all rounds. Each round subtracts its push. The limit at the start is the smallest
  // displacement of the covering triangle's three corners in the shape.
  std::vector<double> max_push;
  for (const CoveredVertex& covered : covered_vertices_) {
    double least = HUGE_VAL;
    for (const std::uint32_t v : covered.covering_triangle) {
      least = std::min(least, (row3(mesh, v) - row3(rest, v)).norm());
    }
    max_push.push_back(least);
  }
  for (int round = 0; round < kFrontRounds; ++round) {
    const std::vector<Push> pushes = find_pushes(mesh, face_motion, max_push);
    if (pushes.empty()) break;
    apply_pushes(pushes, face_motion.scale, rows, mesh, shape);
  }
  for (const std::uint32_t v : shape.vertices) mesh.row(v) = rest.row(v);
}

std::vector<SkinOverParts::Push> SkinOverParts::find_pushes(const Positions& mesh,
                                                            const RigidMotion& face_motion,
                                                            std::span<double> max_push) const {
  const double scale = face_motion.scale;
  const HeadAxes axes = moved_axes(axes_, face_motion);
  const Eigen::Vector3d side = axes.side();
  std::vector<Push> pushes;
  for (std::size_t i = 0; i < covered_vertices_.size(); ++i) {
    const CoveredVertex& covered = covered_vertices_[i];
    if (max_push[i] <= 0) continue;
    const Eigen::Vector3d point = row3(mesh, covered.vertex);
    const Corners over = corners_of(mesh, covered.covering_triangle);
    if ((over[0] - point).dot(normal_of(over)) > kNear * scale * extent_) continue;
    // Find the foremost of the candidate triangles that overlap this vertex, seen from the front.
    // `foremost`: distance of this triangle in front of the vertex; negative if behind.
    std::optional<double> foremost;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (const Triangle& triangle : covered.candidates) {
      const Corners corners = corners_of(mesh, triangle);
      const auto ahead = ahead_of(point, corners, axes, side);
      if (!ahead || (foremost && *ahead <= *foremost)) continue;
      foremost = ahead;
      normal = normal_of(corners);
    }
    const double facing = axes.front.dot(normal);
    if (!foremost || facing < kMinFrontCosine) continue;
    // Push the foremost triangle forward if this triangle is behind the covered vertex, or too
    // close in front of the vertex.
    const double missing = scale * covered.depth - *foremost * facing;
    if (missing <= (1 - kTooNear) * scale * covered.depth) continue;
    const double by = std::min(missing, max_push[i]);
    max_push[i] -= by;
    pushes.push_back({point + *foremost * axes.front, by * normal});
  }
  return pushes;
}

void SkinOverParts::apply_pushes(std::span<const Push> pushes, double scale,
                                 std::span<const DisplacementRow> rows, Positions& mesh,
                                 Displacements& shape) const {
  const double reach = kPushedAround * scale * extent_;
  Eigen::AlignedBox3d box;
  for (const Push& push : pushes) box.extend(push.position);
  box = {box.min().array() - reach, box.max().array() + reach};
  for (const auto& [row, v] : rows) {
    const Eigen::Vector3d here = row3(mesh, v);
    if (!box.contains(here)) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double longest = 0;
    for (const Push& push : pushes) {
      const double distance = (push.position - here).norm() / reach;
      if (distance >= 1) continue;
      const double weight = biweight(distance);
      sum += weight * push.displacement;
      longest = std::max(longest, weight * push.displacement.norm());
    }
    if (longest == 0) continue;
    const Eigen::RowVector3d by = (longest * sum.normalized()).transpose();
    shape.moves.row(row) += by;
    mesh.row(v) += by;
  }
}

}  // namespace crowdface
