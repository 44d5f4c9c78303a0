// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/facing_skin.h"

namespace crowdface {

/// A point on an edge of a mesh: the same part of the way from a to b in every head.
struct EdgePoint {
  std::uint32_t a, b;
  double share;  ///< of b
};

/// A place where a gap is measured: two short profiles, cut across the two sides on the mean head, and
/// the direction that separates them there.
struct ContactPlace {
  Eigen::Vector3d middle, up;  ///< on the mean head; unit, from the low side to the high one
  Eigen::Vector3d along;       ///< unit: normal to the cut
  std::vector<EdgePoint> low, high;

  /// How far the lowest point of the high profile is above the highest of the low one; negative where
  /// they overlap.
  double gap(const Positions& positions) const;
  /// Unit: into the contact, within the cut.
  Eigen::Vector3d deep() const { return along.cross(up); }
};

/// Places evenly spread over a group, without profiles.
/// \param spacing  at least so far from each other; none of the group's pairs is farther from all
std::vector<ContactPlace> places_among(const FacingGroup& group, double spacing);

/// Cuts the profiles of a place, some may be empty.
/// \param vertices  those around the group
/// \param side      #V: positive on the high side, negative on the low one
/// \param reach     of the profiles, from the place's middle
void cut_profiles(const Adjacency& adjacency, const Positions& mean,
                  std::span<const std::uint32_t> vertices, const std::vector<double>& side,
                  double reach, ContactPlace& place);

/// Of an edge's point above the origin, along a direction.
inline double height_of(const EdgePoint& point, const Eigen::Vector3d& up,
                        const Positions& positions) {
  return (1 - point.share) * row3(positions, point.a).dot(up) +
         point.share * row3(positions, point.b).dot(up);
}

/// How far apart the two profiles of a place are where one is above the other. Of an upper lip whose inner
/// rim hangs down behind the lower one the lowest point tells nothing: the slit in front of it is seen.
class Clearance {
 public:
  Clearance(const ContactPlace& place, const Adjacency& adjacency);

  /// A point of the low profile and one of the high profile as deep as it, each between two points.
  struct Opposite {
    std::array<std::uint32_t, 2> low, high;         ///< low points first, high ones after them
    std::array<double, 2> low_shares, high_shares;  ///< of the points; sum 1

    /// \param heights  of all points
    double gap(std::span<const double> heights) const {
      return high_shares[0] * heights[high[0]] + high_shares[1] * heights[high[1]] -
             low_shares[0] * heights[low[0]] - low_shares[1] * heights[low[1]];
    }
  };
  /// Where the profiles' pieces begin or end above each other; at one of them the gap is smallest, since
  /// pieces are straight. At least one: where nothing is above anything, the points nearest in depth.
  /// \param depths  of all points
  std::vector<Opposite> opposites(std::span<const double> depths) const;
  /// Of all points, low ones first: along `up` and along `deep()` of the place.
  std::vector<double> heights(const Positions& positions) const { return along(up_, positions); }
  std::vector<double> depths(const Positions& positions) const { return along(deep_, positions); }
  /// The smallest of some opposites; negative where the profiles cross.
  static double gap(std::span<const Opposite> opposites, std::span<const double> heights);
  double gap(const Positions& positions) const;

 private:
  /// Two points next to each other, or one that has none.
  using Piece = std::array<std::uint32_t, 2>;

  std::vector<double> along(const Eigen::Vector3d& direction, const Positions& positions) const;

  std::vector<EdgePoint> points_;  ///< low ones first
  std::vector<Piece> low_, high_;
  Eigen::Vector3d up_, deep_;
};

}  // namespace crowdface
