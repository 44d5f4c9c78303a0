// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/smooth_bend.h"

#include <algorithm>
#include <numeric>

#include "crowdface/core/parallel.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {
namespace {

constexpr std::size_t kNodesPerBlock = 64;
constexpr Index kPointsPerBlock = 1024;

/// Chooses nodes among the points, in the order of the points: a point becomes a node if no earlier
/// node is near (see BendNodes::kNodeSpacing). Adds the patch of each node to `patches`.
/// \return the indices of the points that are nodes.
std::vector<std::uint32_t> find_nodes(const FittedSkin& skin, const Positions& points,
                                      const PointGrid& grid,
                                      std::vector<FittedSkin::Patch>& patches) {
  std::vector<std::uint32_t> places;
  std::vector<bool> covered(static_cast<std::size_t>(points.rows()), false);
  for (std::uint32_t p = 0; p < covered.size(); ++p) {
    if (covered[p]) continue;
    const Eigen::Vector3d middle = row3(points, p);
    places.push_back(p);
    patches.push_back(skin.patch_around(middle));
    const double apart = BendNodes::kNodeSpacing * patches.back().radius;
    for (const std::uint32_t other : grid.vertices_near(middle, apart)) {
      if ((row3(points, other) - middle).norm() < apart) covered[other] = true;
    }
    covered[p] = true;
  }
  return places;
}

}  // namespace

SmoothBend::SmoothBend(const FittedSkin& skin, const Positions& points)
    : skin_(skin), points_(points) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(points.rows()));
  if (all.empty()) return;
  std::iota(all.begin(), all.end(), 0U);
  const PointGrid grid(points, all);
  const std::vector<std::uint32_t> places = find_nodes(skin, points, grid, nodes_.patches);
  nodes_.node_weights = compressed_rows<BendNodes::NodeWeight>(all.size(), [&](const auto& put) {
    for (std::uint32_t n = 0; n < places.size(); ++n) {
      const Eigen::Vector3d middle = row3(points, places[n]);
      const double radius =
          BendNodes::kInfluenceRadius * BendNodes::kNodeSpacing * nodes_.patches[n].radius;
      for (const std::uint32_t p : grid.vertices_near(middle, radius)) {
        const double distance = (row3(points, p) - middle).norm() / radius;
        const double weight = biweight(std::min(1.0, distance));
        if (weight > 0) put(p, {n, static_cast<float>(weight)});
      }
    }
  });
}

Positions SmoothBend::bend(const Positions& face) const {
  std::vector<RigidMotion> motions(nodes_.patches.size());
  parallel_for_each(motions.size(), kNodesPerBlock, [&](std::size_t n) {
    const FittedSkin::Patch& patch = nodes_.patches[n];
    motions[n] = fit_rigid_motion(skin_.mesh_positions(), face, patch.vertices, patch.weights);
  });
  Positions bent(points_.rows(), 3);
  parallel_for_each(points_.rows(), kPointsPerBlock, [&](Index p) {
    const Eigen::Vector3d point = row3(points_, p);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const BendNodes::NodeWeight& share : nodes_.node_weights.items_of(p)) {
      const double weight = static_cast<double>(share.weight);
      sum += weight * motions[share.node].apply(point);
      weights += weight;
    }
    bent.row(p) = (sum / weights).transpose();
  });
  return bent;
}

}  // namespace crowdface
