// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/contact.h"

#include <algorithm>

#include "crowdface/parts/solve3.h"
#include "crowdface/parts/vector3.h"

namespace crowdface {
namespace {

/// More pairs than this change nothing but the time.
constexpr std::size_t kMostVertices = 1500;
/// What a shift costs beside a gap that it closes, a pair.
constexpr double kHold = 1e-3;
constexpr int kSteps = 8;

}  // namespace

Contact::Contact(const Topology& topology, const FacesAround& faces, const Positions& positions,
                 const PointGrid& skin, std::span<const std::uint32_t> part, double reach) {
  const std::size_t count = std::min(part.size(), kMostVertices);
  std::vector<double> heights;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = part[i * part.size() / count];
    const Eigen::Vector3d point = positions.row(v).transpose();
    const auto nearest = skin.nearest(point);
    const SurfacePoint place = nearest_around(topology, faces, positions, nearest.vertex, point);
    if (place.distance > reach) continue;
    pairs_.push_back({v, place.corners, place.shares});
    heights.push_back(height(pairs_.back(), point, positions));
    sum += heights.back() > 0 ? 1 : -1;
  }
  // Most lie on the free side; roots that reach into the flesh may.
  side_ = sum < 0 ? -1 : 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (side_ * heights[i] > 0) pairs_[kept++] = pairs_[i];
  }
  pairs_.resize(kept);
}

Eigen::Vector3d Contact::normal(const Pair& pair, const Positions& head) const {
  const Eigen::Vector3d a = head.row(pair.corners[0]).transpose();
  const Eigen::Vector3d b = head.row(pair.corners[1]).transpose();
  const Eigen::Vector3d c = head.row(pair.corners[2]).transpose();
  return side_ * unit3(cross3(b - a, c - a));
}

double Contact::height(const Pair& pair, const Eigen::Vector3d& point,
                       const Positions& skin) const {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    place += pair.shares[k] * skin.row(pair.corners[k]).transpose();
  }
  return dot3(normal(pair, skin), point - place);
}

std::vector<double> Contact::heights(const Positions& head) const {
  std::vector<double> result;
  for (const Pair& pair : pairs_) {
    result.push_back(height(pair, head.row(pair.vertex).transpose(), head));
  }
  return result;
}

Eigen::Vector3d Contact::clearing_shift(const Positions& target, std::span<const double> before,
                                        const RigidMotion& motion, const Positions& after,
                                        double margin) const {
  // Gauss and Newton on the squares of what is missing; only pairs that miss something count.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  std::vector<double> gap;
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Eigen::Vector3d point = motion.apply(target.row(pairs_[i].vertex).transpose());
    normals.push_back(normal(pairs_[i], after));
    gap.push_back(height(pairs_[i], point, after) - std::min(before[i], margin));
  }
  for (int step = 0; step < kSteps; ++step) {
    double a[3][3] = {}, b[3] = {};
    double missing_pairs = 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Eigen::Vector3d& n = normals[i];
      const double missing = -(gap[i] + dot3(n, shift));
      if (missing <= 0) continue;
      missing_pairs += 1;
      for (Index r = 0; r < 3; ++r) {
        for (Index c = 0; c < 3; ++c) a[r][c] += n(r) * n(c);
        b[r] += n(r) * missing;
      }
    }
    if (missing_pairs == 0) break;
    const double hold = kHold * static_cast<double>(pairs_.size()) + 0.05 * missing_pairs;
    for (Index r = 0; r < 3; ++r) a[r][r] += hold;
    shift += solve3(a, b);
  }
  return shift;
}

}  // namespace crowdface
