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

constexpr std::size_t kPlacesPerBlock = 64;
constexpr Index kPointsPerBlock = 1024;

/// Chooses the nodes among the points, greedily in their order, and collects their patches.
std::vector<std::uint32_t> find_places(const FittedSkin& skin, const Positions& points,
                                       const PointGrid& grid,
                                       std::vector<FittedSkin::Patch>& patches) {
  std::vector<std::uint32_t> places;
  std::vector<bool> covered(static_cast<std::size_t>(points.rows()), false);
  for (std::uint32_t p = 0; p < covered.size(); ++p) {
    if (covered[p]) continue;
    const Eigen::Vector3d middle = row3(points, p);
    places.push_back(p);
    patches.push_back(skin.patch_around(middle));
    const double apart = BendPlaces::kApart * patches.back().reach;
    for (const std::uint32_t other : grid.about(middle, apart)) {
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
  const std::vector<std::uint32_t> places = find_places(skin, points, grid, places_.patches);
  places_.shares = compressed_rows<BendPlaces::Share>(all.size(), [&](const auto& put) {
    for (std::uint32_t n = 0; n < places.size(); ++n) {
      const Eigen::Vector3d middle = row3(points, places[n]);
      const double heard = BendPlaces::kHeard * BendPlaces::kApart * places_.patches[n].reach;
      for (const std::uint32_t p : grid.about(middle, heard)) {
        const double distance = (row3(points, p) - middle).norm() / heard;
        const double weight = biweight(std::min(1.0, distance));
        if (weight > 0) put(p, {n, static_cast<float>(weight)});
      }
    }
  });
}

Positions SmoothBend::bend(const Positions& face) const {
  std::vector<RigidMotion> motions(places_.patches.size());
  parallel_for_each(motions.size(), kPlacesPerBlock, [&](std::size_t n) {
    const FittedSkin::Patch& patch = places_.patches[n];
    motions[n] = fit_rigid_motion(skin_.mesh(), face, patch.vertices, patch.weights);
  });
  Positions bent(points_.rows(), 3);
  parallel_for_each(points_.rows(), kPointsPerBlock, [&](Index p) {
    const Eigen::Vector3d point = row3(points_, p);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const BendPlaces::Share& share : places_.shares.of(p)) {
      const double weight = static_cast<double>(share.weight);
      sum += weight * motions[share.place].apply(point);
      weights += weight;
    }
    bent.row(p) = (sum / weights).transpose();
  });
  return bent;
}

}  // namespace crowdface
