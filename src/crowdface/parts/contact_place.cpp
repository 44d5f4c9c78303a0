// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/contact_place.h"

#include <algorithm>
#include <limits>

#include "crowdface/mesh/vector3.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

/// Pairs within so many spacings of a place tell how the group runs there, and which way is up.
constexpr double kCourse = 4, kUp = 1.5;

/// The direction in which the middles of some pairs are spread most, perpendicular to another one.
Eigen::Vector3d course(const FacingGroup& group, const Eigen::Vector3d& middle, double reach,
                       const Eigen::Vector3d& up) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const FacingPair& pair : group) {
    const Eigen::Vector3d from = pair.middle - middle;
    if (length3(from) > reach) continue;
    const Eigen::Vector3d flat = from - dot3(from, up) * up;
    for (Index i = 0; i < 3; ++i) {
      for (Index j = 0; j < 3; ++j) spread(i, j) += flat(i) * flat(j);
    }
  }
  const Eigen::Vector3d main = symmetric_eigen(spread).vectors.col(0);
  const Eigen::Vector3d flat = main - dot3(main, up) * up;
  if (length3(flat) > 0.1) return unit3(flat);
  const Eigen::Vector3d axis =
      std::abs(up.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return unit3(cross3(up, axis));
}

}  // namespace

double ContactPlace::gap(const Positions& positions) const {
  double lowest = std::numeric_limits<double>::max(), highest = -lowest;
  for (const EdgePoint& point : high) lowest = std::min(lowest, height_of(point, up, positions));
  for (const EdgePoint& point : low) highest = std::max(highest, height_of(point, up, positions));
  return lowest - highest;
}

std::vector<ContactPlace> places_among(const FacingGroup& group, double spacing) {
  std::vector<double> nearest(group.size(), std::numeric_limits<double>::max());
  std::vector<ContactPlace> places;
  for (std::size_t next = 0; nearest[next] >= spacing;) {  // the farthest from all so far
    const Eigen::Vector3d middle = group[next].middle;
    Eigen::Vector3d up = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const double distance = length3(group[i].middle - middle);
      nearest[i] = std::min(nearest[i], distance);
      if (distance <= kUp * spacing) up += group[i].up;
    }
    up = unit3(up);
    places.push_back({middle, up, course(group, middle, kCourse * spacing, up), {}, {}});
    next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
  }
  return places;
}

void cut_profiles(const Adjacency& adjacency, const Positions& mean,
                  std::span<const std::uint32_t> vertices, const std::vector<double>& side,
                  double reach, ContactPlace& place) {
  const auto off_cut = [&](std::uint32_t v) {
    return dot3(mean.row(v).transpose() - place.middle, place.along);
  };
  for (const std::uint32_t a : vertices) {
    const double at = off_cut(a);
    if (std::abs(at) > reach) continue;
    for (const std::uint32_t b : adjacency.of(a)) {
      if (b < a || side[a] * side[b] <= 0) continue;
      const double bt = off_cut(b);
      if ((at > 0) == (bt > 0)) continue;
      const EdgePoint point{a, b, at / (at - bt)};
      const Eigen::Vector3d position =
          ((1 - point.share) * mean.row(a) + point.share * mean.row(b)).transpose();
      if (length3(position - place.middle) > reach) continue;
      (side[a] > 0 ? place.high : place.low).push_back(point);
    }
  }
}

}  // namespace crowdface
