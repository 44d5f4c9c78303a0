// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/anchors.h"

#include <algorithm>
#include <map>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// The vertices of all faces around the corners, ascending.
std::vector<std::uint32_t> ring_of(const Topology& topology, const FacesAround& faces,
                                   const std::array<std::uint32_t, 3>& corners) {
  std::vector<std::uint32_t> ring;
  for (const std::uint32_t corner : corners) {
    for (const std::uint32_t f : faces.of(corner)) {
      ring.insert(ring.end(), topology.face(f).begin(), topology.face(f).end());
    }
  }
  std::ranges::sort(ring);
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

}  // namespace

Anchors::Anchors(const Topology& topology, const FacesAround& faces, const Positions& positions,
                 const PointGrid& skin, std::vector<std::uint32_t> bound)
    : bound_(std::move(bound)) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  for (const std::uint32_t v : bound_) {
    const Eigen::Vector3d point = positions.row(v).transpose();
    const SurfacePoint place =
        nearest_around(topology, faces, positions, skin.nearest(point).vertex, point);
    const auto [entry, is_new] =
        known.emplace(place.corners, static_cast<std::uint32_t>(sites_.size()));
    site_of_.push_back(entry->second);
    shares_.push_back(place.shares);
    if (!is_new) continue;
    Site site{place.corners, static_cast<std::uint32_t>(ring_.size()), 0};
    const std::vector<std::uint32_t> ring = ring_of(topology, faces, place.corners);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t r : ring) middle += positions.row(r).transpose();
    middle /= static_cast<double>(ring.size());
    const Eigen::Vector3d along =
        unit3(row3(positions, place.corners[1]) - row3(positions, place.corners[0]));
    const Eigen::Vector3d across = cross3(normal_at(positions, place), along);
    for (const std::uint32_t r : ring) {
      const Eigen::Vector3d from = positions.row(r).transpose() - middle;
      ring_.push_back({r, dot3(from, along), dot3(from, across)});
    }
    site.end = static_cast<std::uint32_t>(ring_.size());
    sites_.push_back(site);
  }
}

Anchors::Frame Anchors::frame_at(const Site& site, const Positions& positions) const {
  double along[3] = {}, across[3] = {};
  for (std::uint32_t i = site.begin; i < site.end; ++i) {
    const RingVertex& ring = ring_[i];
    for (Index c = 0; c < 3; ++c) {
      // From the first corner, so that where the head stands makes no difference to rounding.
      const double x = positions(ring.vertex, c) - positions(site.corners[0], c);
      along[c] += ring.along * x;
      across[c] += ring.across * x;
    }
  }
  const Eigen::Vector3d x = unit3({along[0], along[1], along[2]});
  const Eigen::Vector3d z = unit3(cross3(x, {across[0], across[1], across[2]}));
  return {x, cross3(z, x), z};
}

Eigen::Vector3d Anchors::origin(std::size_t i, const Positions& positions) const {
  return point_on(positions, sites_[site_of_[i]].corners, shares_[i]);
}

bool Anchors::unmoved(const Site& site, const Positions& before, const Positions& after) const {
  return std::all_of(ring_.begin() + site.begin, ring_.begin() + site.end, [&](const auto& ring) {
    return before.row(ring.vertex) == after.row(ring.vertex);
  });
}

std::vector<Eigen::Vector3d> Anchors::places(const Positions& head) const {
  std::vector<Frame> frames;
  for (const Site& site : sites_) frames.push_back(frame_at(site, head));
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < bound_.size(); ++i) {
    const Eigen::Vector3d offset = head.row(bound_[i]).transpose() - origin(i, head);
    const Frame& frame = frames[site_of_[i]];
    result.emplace_back(dot3(offset, frame[0]), dot3(offset, frame[1]), dot3(offset, frame[2]));
  }
  return result;
}

void Anchors::put(const Positions& target, std::span<const Eigen::Vector3d> places,
                  Positions& result) const {
  std::vector<Frame> frames;
  std::vector<bool> still;
  for (const Site& site : sites_) {
    still.push_back(unmoved(site, target, result));
    frames.push_back(still.back() ? Frame{} : frame_at(site, result));
  }
  for (std::size_t i = 0; i < bound_.size(); ++i) {
    const std::uint32_t v = bound_[i];
    if (still[site_of_[i]]) {
      result.row(v) = target.row(v);
      continue;
    }
    const Frame& frame = frames[site_of_[i]];
    const Eigen::Vector3d offset =
        places[i].x() * frame[0] + places[i].y() * frame[1] + places[i].z() * frame[2];
    result.row(v) = (origin(i, result) + offset).transpose();
  }
}

}  // namespace crowdface
