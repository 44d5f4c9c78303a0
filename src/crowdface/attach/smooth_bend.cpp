// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/smooth_bend.h"

#include <numeric>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {
namespace {

/// How far places are apart, as a share of how far they hear the skin, and how far points hear them,
/// in such distances.
constexpr double kApart = 0.3, kHeard = 2;
constexpr std::size_t kPlacesPerBlock = 64;
constexpr Index kPointsPerBlock = 1024;

double bump(double distance) {
  const double rest = 1 - distance * distance;
  return rest > 0 ? rest * rest : 0;
}

/// Points none of which is within the other's distance, and from which all others are.
struct Places {
  std::vector<std::uint32_t> points;
  std::vector<FittedSkin::Patch> patches;
};

Places find_places(const FittedSkin& skin, const Positions& points, const PointGrid& grid) {
  Places places;
  std::vector<bool> covered(static_cast<std::size_t>(points.rows()), false);
  for (std::uint32_t p = 0; p < covered.size(); ++p) {
    if (covered[p]) continue;
    const Eigen::Vector3d middle = row3(points, p);
    places.points.push_back(p);
    places.patches.push_back(skin.patch_around(middle));
    const double apart = kApart * places.patches.back().reach;
    for (const std::uint32_t other : grid.about(middle, apart)) {
      if (length3(row3(points, other) - middle) < apart) covered[other] = true;
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
  Places places = find_places(skin, points, grid);
  places_ = std::move(places.patches);
  shares_ = grouped<Share>(all.size(), [&](const auto& put) {
    for (std::uint32_t n = 0; n < places_.size(); ++n) {
      const Eigen::Vector3d middle = row3(points, places.points[n]);
      const double heard = kHeard * kApart * places_[n].reach;
      for (const std::uint32_t p : grid.about(middle, heard)) {
        const double weight = bump(length3(row3(points, p) - middle) / heard);
        if (weight > 0) put(p, Share{n, static_cast<float>(weight)});
      }
    }
  });
}

std::size_t SmoothBend::memory_bytes() const {
  std::size_t bytes = shares_.items.size() * sizeof(Share);
  for (const FittedSkin::Patch& place : places_) {
    bytes += sizeof(place) + place.vertices.size() * (sizeof(std::uint32_t) + sizeof(double));
  }
  return bytes;
}

Positions SmoothBend::bend(const Positions& face) const {
  std::vector<RigidMotion> motions(places_.size());
  parallel_for_each(places_.size(), kPlacesPerBlock, [&](std::size_t n) {
    motions[n] = fit_rigid_motion(skin_.mesh(), face, places_[n].vertices, places_[n].weights);
  });
  Positions bent(points_.rows(), 3);
  parallel_blocks(points_.rows(), kPointsPerBlock, [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p) {
      const Eigen::Vector3d point = row3(points_, p);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weights = 0;
      for (const Share& share : shares_.of(p)) {
        const double weight = static_cast<double>(share.weight);
        sum += weight * motions[share.place].apply(point);
        weights += weight;
      }
      bent.row(p) = (sum / weights).transpose();
    }
  });
  return bent;
}

}  // namespace crowdface
