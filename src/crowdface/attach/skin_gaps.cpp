// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/skin_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// The gap of a vertex is its distance from the skin. restore_gaps does not correct the gap of a
/// vertex whose original gap, on the fitted mesh, is wider than kFarMm plus two vertex spacings of
/// the skin.
constexpr double kFarMm = 25;
/// A vertex whose original gap is at most kCloseMm gets exactly this gap again. For vertices with
/// wider original gaps, the correction decreases linearly and is zero at kLooseMm.
constexpr double kCloseMm = 2, kLooseMm = 6;
/// A vertex outside the skin keeps at least this distance from the skin. If the vertex's original
/// gap is smaller, the original gap is the minimum.
constexpr double kMinGapMm = 2;
/// Number of rounds in which vertices with a corrected gap move their neighbours too.
constexpr int kRounds = 8;
constexpr std::uint32_t kGapsPerBlock = 512;
constexpr double kNoGap = std::numeric_limits<double>::infinity();

}  // namespace

SkinGaps::SkinGaps(const FittedSkin& skin, const Topology& topology, const Positions& points)
    : skin_(skin),
      heights_(static_cast<std::size_t>(points.rows()), kNoGap),
      start_vertices_(heights_.size(), 0),
      neighbours_(build_adjacency(topology)) {
  const Positions normals = skin.normals(skin.mesh_positions());
  const double far = kFarMm * skin.units_per_mm() + 2 * skin.vertex_spacing();
  parallel_for_each(heights_.size(), kGapsPerBlock, [&](std::size_t p) {
    const Eigen::Vector3d point = row3(points, static_cast<Index>(p));
    const PointGrid::NearestVertex nearest = skin.grid().nearest(point, far);
    if (nearest.vertex == kNoIndex) return;
    start_vertices_[p] = nearest.vertex;
    heights_[p] = skin.nearest_skin(skin.mesh_positions(), normals, nearest.vertex, point).height;
  });
}

std::size_t SkinGaps::memory_bytes() const {
  return heights_.size() * (sizeof(double) + sizeof(std::uint32_t)) +
         neighbours_.items.size() * sizeof(std::uint32_t);
}

double SkinGaps::min_height(std::uint32_t point) const {
  return std::min(heights_[point], kMinGapMm * skin_.units_per_mm());
}

std::vector<SkinGaps::Violation> SkinGaps::violations(const Positions& face,
                                                      const Positions& normals,
                                                      const Positions& points) const {
  std::vector<Violation> all;
  for (std::uint32_t p = 0; p < heights_.size(); ++p) {
    if (heights_[p] == kNoGap || heights_[p] < 0) continue;
    const NearestSkinPoint place =
        skin_.nearest_skin(face, normals, start_vertices_[p], row3(points, p));
    const double missing = min_height(p) - place.height;
    if (missing > 0) all.push_back({p, missing, place.outward_normal});
  }
  return all;
}

void SkinGaps::restore_gaps(const Positions& face, const Positions& normals,
                            Positions& points) const {
  Positions moves = Positions::Zero(points.rows(), 3), outward_normal = moves;
  const auto count = static_cast<std::uint32_t>(heights_.size());
  parallel_for_each(count, kGapsPerBlock, [&](std::uint32_t p) {
    if (heights_[p] == kNoGap) return;
    const NearestSkinPoint place =
        skin_.nearest_skin(face, normals, start_vertices_[p], row3(points, p));
    // Move a point that was near the fitted skin to its original distance from the skin. Move a
    // point that was outside the fitted skin at least to its minimum distance (min_height).
    const double off = std::abs(heights_[p]) / skin_.units_per_mm();
    const double held = std::clamp((kLooseMm - off) / (kLooseMm - kCloseMm), 0.0, 1.0);
    double move = held * (heights_[p] - place.height);
    if (heights_[p] >= 0) move = std::max(move, min_height(p) - place.height);
    moves.row(p) = move * place.outward_normal.transpose();
    outward_normal.row(p) = place.outward_normal.transpose();
  });
  // If the mean move of a vertex's neighbours is longer than the vertex's own move and does not
  // point into the skin, the vertex moves by this mean.
  for (int round = 0; round < kRounds; ++round) {
    const Positions before = moves;
    parallel_for_each(count, kGapsPerBlock, [&](std::uint32_t p) {
      const auto around = neighbours_.items_of(p);
      if (around.empty()) return;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const std::uint32_t other : around) mean += row3(before, other);
      mean /= static_cast<double>(around.size());
      const bool is_push = mean.dot(row3(outward_normal, p)) >= 0;
      if (is_push && mean.norm() > row3(before, p).norm()) moves.row(p) = mean.transpose();
    });
  }
  points += moves;
}

}  // namespace crowdface
