// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/gap_section.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "crowdface/core/contains.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

/// Search radii around a section's middle, in multiples of the distance between sections. The
/// facing pairs of vertices within kDirectionReach determine the direction along the gap. The
/// facing pairs within kUpReach determine the direction across the gap (GapSection::up).
constexpr double kDirectionReach = 4, kUpReach = 1.5;

/// Returns the direction along a gap at a point: the direction, perpendicular to `up`, in which the
/// midpoints of the facing pairs are spread most. Uses the midpoints within `reach` of `middle`.
Eigen::Vector3d gap_direction(const FacingGroup& group, const Eigen::Vector3d& middle, double reach,
                              const Eigen::Vector3d& up) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const FacingPair& pair : group) {
    const Eigen::Vector3d from = pair.middle - middle;
    if (from.norm() > reach) continue;
    const Eigen::Vector3d flat = from - from.dot(up) * up;
    spread += flat * flat.transpose();
  }
  const Eigen::Vector3d main = symmetric_eigen(spread).eigenvectors.col(0);
  const Eigen::Vector3d flat = main - main.dot(up) * up;
  if (flat.norm() > 0.1) return flat.normalized();
  const Eigen::Vector3d axis =
      std::abs(up.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return up.cross(axis).normalized();
}

bool are_neighbours(const Adjacency& adjacency, std::uint32_t a, std::uint32_t b) {
  return a == b || contains(adjacency.items_of(a), b);
}

/// Returns whether two edges belong to the same polygon, so that they can be consecutive in a cut.
/// This is the case if the edges share an end and their other ends are neighbours, or if the edges
/// are opposite sides of a quad.
bool share_a_face(const Adjacency& adjacency, const EdgePoint& p, const EdgePoint& q) {
  const auto joined = [&](std::uint32_t qa, std::uint32_t qb) {
    return are_neighbours(adjacency, p.a, qa) && are_neighbours(adjacency, p.b, qb);
  };
  const bool share_an_end = p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b;
  return share_an_end || joined(q.a, q.b) || joined(q.b, q.a);
}

}  // namespace

double GapSection::gap(const Positions& positions) const {
  double lowest = std::numeric_limits<double>::max(), highest = -lowest;
  for (const EdgePoint& point : high_profile)
    lowest = std::min(lowest, height_of(point, up, positions));
  for (const EdgePoint& point : low_profile)
    highest = std::max(highest, height_of(point, up, positions));
  return lowest - highest;
}

std::vector<GapSection> distribute_gap_sections(const FacingGroup& group, double spacing) {
  std::vector<double> nearest(group.size(), std::numeric_limits<double>::max());
  std::vector<GapSection> sections;
  // Each round places a section at pair `next`, the pair that is farthest from all earlier
  // sections.
  for (std::size_t next = 0; nearest[next] >= spacing;) {
    const Eigen::Vector3d middle = group[next].middle;
    Eigen::Vector3d up = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const double distance = (group[i].middle - middle).norm();
      nearest[i] = std::min(nearest[i], distance);
      if (distance <= kUpReach * spacing) up += group[i].up;
    }
    up = up.normalized();
    sections.push_back(
        {middle, up, gap_direction(group, middle, kDirectionReach * spacing, up), {}, {}});
    next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
  }
  return sections;
}

void cut_profiles(const Adjacency& adjacency, const Positions& mean,
                  std::span<const std::uint32_t> vertices, const std::vector<double>& side,
                  double reach, GapSection& section) {
  const auto off_cut = [&](std::uint32_t v) {
    return (row3(mean, v) - section.middle).dot(section.plane_normal);
  };
  for (const std::uint32_t a : vertices) {
    const double at = off_cut(a);
    if (std::abs(at) > reach) continue;
    for (const std::uint32_t b : adjacency.items_of(a)) {
      if (b < a || side[a] * side[b] <= 0) continue;
      const double bt = off_cut(b);
      if ((at > 0) == (bt > 0)) continue;
      const EdgePoint point{a, b, at / (at - bt)};
      const Eigen::Vector3d position =
          ((1 - point.fraction) * mean.row(a) + point.fraction * mean.row(b)).transpose();
      if ((position - section.middle).norm() > reach) continue;
      (side[a] > 0 ? section.high_profile : section.low_profile).push_back(point);
    }
  }
}

Clearance::Clearance(const GapSection& section, const Adjacency& adjacency)
    : points_(section.low_profile), up_(section.up), inward_(section.inward()) {
  points_.insert(points_.end(), section.high_profile.begin(), section.high_profile.end());
  const auto add_pieces = [&](std::size_t begin, std::size_t end, std::vector<Segment>& pieces) {
    for (std::size_t i = begin; i < end; ++i) {
      bool alone = true;
      for (std::size_t j = begin; j < end; ++j) {
        if (i == j || !share_a_face(adjacency, points_[i], points_[j])) continue;
        alone = false;
        if (i < j) pieces.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      }
      if (alone) pieces.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i)});
    }
  };
  add_pieces(0, section.low_profile.size(), low_);
  add_pieces(section.low_profile.size(), points_.size(), high_);
}

std::vector<double> Clearance::coordinates(const Eigen::Vector3d& direction,
                                           const Positions& positions) const {
  std::vector<double> heights;
  heights.reserve(points_.size());
  for (const EdgePoint& point : points_) {
    heights.push_back(height_of(point, direction, positions));
  }
  return heights;
}

std::vector<Clearance::OppositePoints> Clearance::opposite_points(
    std::span<const double> depths) const {
  const auto weights_at = [&](const Segment& piece, double depth) {
    const double span = depths[piece[1]] - depths[piece[0]];
    const double of_second =
        span == 0 ? 0.0 : std::clamp((depth - depths[piece[0]]) / span, 0.0, 1.0);
    return std::array{1 - of_second, of_second};
  };
  const auto depth_range = [&](const Segment& piece) {
    return std::array{std::min(depths[piece[0]], depths[piece[1]]),
                      std::max(depths[piece[0]], depths[piece[1]])};
  };
  std::vector<std::array<double, 2>> ranges_of_high;
  for (const Segment& high : high_) ranges_of_high.push_back(depth_range(high));
  std::vector<OppositePoints> opposite_pairs;
  OppositePoints nearest{};
  double least = std::numeric_limits<double>::max();
  for (const Segment& low : low_) {
    const auto [low_from, low_to] = depth_range(low);
    for (std::size_t h = 0; h < high_.size(); ++h) {
      const Segment& high = high_[h];
      const auto [high_from, high_to] = ranges_of_high[h];
      const double from = std::max(low_from, high_from), to = std::min(low_to, high_to);
      const auto at = [&](double depth) {
        return OppositePoints{low, high, weights_at(low, depth), weights_at(high, depth)};
      };
      if (from <= to) {
        opposite_pairs.push_back(at(from));
        if (from < to) opposite_pairs.push_back(at(to));
      } else if (from - to < least) {
        least = from - to;
        nearest = at(from);
      }
    }
  }
  if (opposite_pairs.empty()) opposite_pairs.push_back(nearest);
  return opposite_pairs;
}

double Clearance::gap(std::span<const OppositePoints> opposite_pairs,
                      std::span<const double> heights) {
  double least = std::numeric_limits<double>::max();
  for (const OppositePoints& opposite : opposite_pairs)
    least = std::min(least, opposite.gap(heights));
  return least;
}

double Clearance::gap(const Positions& positions) const {
  return gap(opposite_points(depths(positions)), heights(positions));
}

}  // namespace crowdface
