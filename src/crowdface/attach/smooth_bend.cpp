// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/smooth_bend.h"

#include <numeric>
#include <utility>

#include "crowdface/attach/bend_places.h"
#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {
namespace {

constexpr std::size_t kPlacesPerBlock = 64;
constexpr Index kPointsPerBlock = 1024;

}  // namespace

SmoothBend::SmoothBend(const FittedSkin& skin, const Positions& points)
    : skin_(skin), points_(points) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(points.rows()));
  if (all.empty()) return;
  std::iota(all.begin(), all.end(), 0U);
  const PointGrid grid(points, all);
  BendPlaces places = find_places(skin, points, grid);
  shares_ = grouped<Share>(all.size(), [&](const auto& put) {
    for (std::uint32_t n = 0; n < places.points.size(); ++n) {
      visit_hearers(points, grid, places, n, [&](std::uint32_t p, double weight) {
        put(p, Share{n, static_cast<float>(weight)});
      });
    }
  });
  places_ = std::move(places.patches);
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
