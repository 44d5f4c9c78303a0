// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/fitted_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <utility>

#include "crowdface/core/require.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

/// The radius of the patch around a point on the skin is kMinRadiusMm millimetres or
/// kMinRadiusSpacings vertex spacings, whichever is larger. For a point at distance d from the
/// skin, the radius is larger by kRadiusGrowth · d.
constexpr double kMinRadiusMm = 6, kMinRadiusSpacings = 3, kRadiusGrowth = 1.5;
/// The radius of a patch is at least kRadiusFactor times the distance from the patch's centre to
/// the kMinVertices-th nearest vertex of the skin.
constexpr std::size_t kMinVertices = 12;
constexpr double kRadiusFactor = 1.4;
/// A patch uses one or two levels of detail of the skin. The choice begins with the finest level.
/// Let q be the patch's radius divided by the vertex spacing of the level.
/// - q ≤ kMaxRadiusSpacings: the patch uses only this level.
/// - kMaxRadiusSpacings < q < 2 · kMaxRadiusSpacings: the patch mixes this level and the next
///   coarser level.
/// - Otherwise, the choice continues with the next coarser level.
constexpr double kMaxRadiusSpacings = 3;
/// A level with at most this number of vertices gets no coarser level.
constexpr std::size_t kMaxCoarsestVertices = 150;

/// A skin vertex and the grid cell that contains the vertex.
struct CellVertex {
  std::array<std::int64_t, 3> cell;
  std::uint32_t vertex;
  auto operator<=>(const CellVertex&) const = default;  // NOLINT(modernize-use-nullptr)
};

}  // namespace

FittedSkin::FittedSkin(const Topology& topology, Positions mesh, std::vector<std::uint32_t> skin,
                       double units_per_mm)
    : topology_(topology),
      positions_(std::move(mesh)),
      skin_vertices_(std::move(skin)),
      units_per_mm_(units_per_mm),
      vertex_faces_(topology),
      fans_(topology),
      areas_(static_cast<std::size_t>(topology.vertex_count), 0.0) {
  require(positions_.rows() == topology.vertex_count && skin_vertices_.size() >= 3,
          "fitted skin: ", positions_.rows(), " positions, ", skin_vertices_.size(),
          " vertices of skin");
  // Compute the vertices' areas, and the sign of the volume, which shows whether normals point
  // inwards.
  const Positions vectors = face_area_vectors(topology, positions_);
  std::vector<bool> is_skin(areas_.size(), false);
  for (const std::uint32_t v : skin_vertices_) is_skin[v] = true;
  const Eigen::Vector3d middle = centre_of(positions_, skin_vertices_);
  double volume = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (!is_skin[face[0]]) continue;
    const Eigen::Vector3d vector = row3(vectors, f);
    const double share = vector.norm() / 2 / static_cast<double>(face.size());
    for (const std::uint32_t v : face) areas_[v] += share;
    volume += vector.dot(row3(positions_, face[0]) - middle);
  }
  normal_sign_ = volume < 0 ? -1 : 1;
  double area = 0;
  for (const std::uint32_t v : skin_vertices_) area += areas_[v];
  const double spacing = std::sqrt(area / static_cast<double>(skin_vertices_.size()));
  require(spacing > 0, "fitted skin: no area");
  add_level(spacing, skin_vertices_, areas_);
  // Add coarser levels for larger patches.
  while (levels_.back().vertices.size() > kMaxCoarsestVertices) {
    const std::size_t before = levels_.back().vertices.size();
    add_coarser_level(2 * levels_.back().spacing);
    if (levels_.back().vertices.size() == before) break;
  }
}

void FittedSkin::add_level(double spacing, std::vector<std::uint32_t> vertices,
                           std::vector<double> areas) {
  PointGrid grid(positions_, vertices);
  levels_.push_back({spacing, std::move(vertices), std::move(areas), std::move(grid)});
}

/// In each cell, picks the vertex that is nearest to the centroid of the cell's skin, and gives
/// this vertex the area of all skin in the cell.
void FittedSkin::add_coarser_level(double spacing) {
  std::vector<CellVertex> cells;
  const Eigen::Vector3d low = row3(positions_, skin_vertices_.front());
  for (const std::uint32_t v : skin_vertices_) {
    const Eigen::Vector3d at = (row3(positions_, v) - low) / spacing;
    cells.push_back({{static_cast<std::int64_t>(std::floor(at.x())),
                      static_cast<std::int64_t>(std::floor(at.y())),
                      static_cast<std::int64_t>(std::floor(at.z()))},
                     v});
  }
  std::ranges::sort(cells);
  std::vector<std::uint32_t> vertices;
  std::vector<double> areas(areas_.size(), 0.0);
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double area = 0;
    for (; end < cells.size() && cells[end].cell == cells[begin].cell; ++end) {
      middle += areas_[cells[end].vertex] * row3(positions_, cells[end].vertex);
      area += areas_[cells[end].vertex];
    }
    if (area > 0) {
      middle /= area;
      std::uint32_t chosen = cells[begin].vertex;
      double least = std::numeric_limits<double>::max();
      for (std::size_t i = begin; i < end; ++i) {
        const double distance = (row3(positions_, cells[i].vertex) - middle).norm();
        if (distance >= least) continue;
        least = distance;
        chosen = cells[i].vertex;
      }
      vertices.push_back(chosen);
      areas[chosen] = area;
    }
    begin = end;
  }
  std::ranges::sort(vertices);
  add_level(spacing, std::move(vertices), std::move(areas));
}

double FittedSkin::patch_radius_at(const Eigen::Vector3d& point, double min_radius) const {
  const Level& finest = levels_.front();
  const double nearest = finest.grid.nearest(point).distance;
  const double reach = kRadiusGrowth * nearest + min_radius;
  const std::size_t fewest = std::min(kMinVertices, finest.vertices.size());
  std::vector<double> distances;
  for (double around = reach / kRadiusFactor;; around *= 2) {
    distances.clear();
    for (const std::uint32_t v : finest.grid.vertices_near(point, around)) {
      const double distance = (row3(positions_, v) - point).norm();
      if (distance <= around) distances.push_back(distance);
    }
    if (distances.size() >= fewest) break;
  }
  return std::max(reach, kRadiusFactor * nth_smallest(std::move(distances), fewest - 1));
}

void FittedSkin::add_patch_vertices(const Level& level, const Eigen::Vector3d& point, double share,
                                    Patch& patch) const {
  if (share <= 0) return;
  for (const std::uint32_t v : level.grid.vertices_near(point, patch.radius)) {
    const double away = std::min(1.0, (row3(positions_, v) - point).norm() / patch.radius);
    const double weight = share * level.areas[v] * biweight(away);
    if (weight <= 0) continue;
    patch.vertices.push_back(v);
    patch.weights.push_back(weight);
  }
}

FittedSkin::Patch FittedSkin::patch_around(const Eigen::Vector3d& point) const {
  return patch_around(
      point, std::max(kMinRadiusMm * units_per_mm_, kMinRadiusSpacings * vertex_spacing()));
}

FittedSkin::Patch FittedSkin::patch_around(const Eigen::Vector3d& point, double min_radius) const {
  Patch patch;
  patch.radius = patch_radius_at(point, min_radius);
  std::size_t level = 0;
  while (level + 1 < levels_.size() &&
         patch.radius > 2 * kMaxRadiusSpacings * levels_[level].spacing) {
    ++level;
  }
  double next = 0;
  if (level + 1 < levels_.size()) {
    next = std::clamp(patch.radius / (kMaxRadiusSpacings * levels_[level].spacing) - 1, 0.0, 1.0);
  }
  add_patch_vertices(levels_[level], point, 1 - next, patch);
  if (next > 0) add_patch_vertices(levels_[level + 1], point, next, patch);
  return patch;
}

Positions FittedSkin::normals(const Positions& face) const {
  return normal_sign_ * fans_.normals(topology_, face, {0, 0, 0});
}

NearestSkinPoint FittedSkin::nearest_skin(const Positions& face, const Positions& normals,
                                          std::uint32_t start, const Eigen::Vector3d& point) const {
  const SurfacePoint place = nearest_point_from(
      topology_, vertex_faces_, face,
      walk_to_nearest_vertex(topology_, vertex_faces_, face, start, point), point);
  const Eigen::Vector3d outward_normal =
      point_on(normals, place.corners, place.barycentric).normalized();
  return {place.corners[0], (point - place.position).dot(outward_normal), outward_normal,
          place.position};
}

}  // namespace crowdface
