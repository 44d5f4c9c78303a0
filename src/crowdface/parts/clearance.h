// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/parts/contact_place.h"

namespace crowdface {

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
