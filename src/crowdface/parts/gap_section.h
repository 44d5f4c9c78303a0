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

/// A point on the edge between the vertices `a` and `b`, at the same fraction of the edge in every
/// head.
struct EdgePoint {
  std::uint32_t a, b;
  double fraction;  ///< position on the edge: 0 at vertex a, 1 at vertex b
};

/// A cutting plane in which the gap between two facing sides of the skin is measured. On the mean
/// head, the plane cuts a short curve (profile) out of each side.
struct GapSection {
  /// `middle`: position of the section's middle on the mean head. `up`: unit vector from one side
  /// of the gap (the "low" side) to the other (the "high" side).
  Eigen::Vector3d middle, up;
  Eigen::Vector3d plane_normal;  ///< unit normal of the cutting plane
  /// The points of the profile on the low side of the gap, and of the profile on the high side.
  std::vector<EdgePoint> low_profile, high_profile;

  /// Returns the height of the lowest point of the high profile above the highest point of the low
  /// profile; negative if the profiles overlap.
  double gap(const Positions& positions) const;
  /// Returns the unit vector that lies in the cutting plane and is perpendicular to `up`. Depths
  /// are measured along this vector.
  Eigen::Vector3d inward() const { return plane_normal.cross(up); }
};

/// Returns sections that are spread evenly over a group of facing pairs. The profiles of the
/// returned sections are empty; `cut_profiles` fills the profiles.
///
/// \param spacing  Minimum distance between two sections. Every facing pair of the group is nearer
///                 than this distance to at least one section.
std::vector<GapSection> distribute_gap_sections(const FacingGroup& group, double spacing);

/// Cuts the two profiles of a section. One profile or both profiles may stay empty.
///
/// \param vertices  Vertices of the skin around the group of facing pairs for which the section was
///                  made (see distribute_gap_sections).
/// \param side      One value per vertex of the mesh: positive on the high side, negative on the
///                  low side.
/// \param reach     Largest distance of a profile's points from the section's middle.
void cut_profiles(const Adjacency& adjacency, const Positions& mean,
                  std::span<const std::uint32_t> vertices, const std::vector<double>& side,
                  double reach, GapSection& section);

/// Returns the coordinate of an edge point along the direction `up`.
inline double height_of(const EdgePoint& point, const Eigen::Vector3d& up,
                        const Positions& positions) {
  return (1 - point.fraction) * row3(positions, point.a).dot(up) +
         point.fraction * row3(positions, point.b).dot(up);
}

/// Measures the smallest gap between the two profiles of a section, at depths where both profiles
/// have points. If the inner rim of the upper lip hangs behind the lower lip, the lowest point of
/// the rim is hidden, and the gap is measured at the visible slit in front of the rim.
class Clearance {
 public:
  Clearance(const GapSection& section, const Adjacency& adjacency);

  /// A point on the low profile and a point on the high profile at the same depth, each
  /// interpolated between two neighbouring profile points.
  struct OppositePoints {
    /// Indices, in the list of all profile points (`points_`), of two neighbouring points of the
    /// low profile. The opposite point on the low profile is interpolated between these two.
    std::array<std::uint32_t, 2> low_indices;
    /// Indices, in the list of all profile points (`points_`), of two neighbouring points of the
    /// high profile. The opposite point on the high profile is interpolated between these two.
    std::array<std::uint32_t, 2> high_indices;
    /// weights of `low_indices` and of `high_indices`; each pair sums to one
    std::array<double, 2> low_weights, high_weights;

    /// Returns the height of the high point above the low point.
    /// \param heights  Heights of all profile points, from heights().
    double gap(std::span<const double> heights) const {
      return high_weights[0] * heights[high_indices[0]] +
             high_weights[1] * heights[high_indices[1]] - low_weights[0] * heights[low_indices[0]] -
             low_weights[1] * heights[low_indices[1]];
    }
  };
  /// Returns pairs of opposite points: each profile point, and the point at the same depth on each
  /// segment of the opposite profile that covers this depth. Segments are straight, so the gap is
  /// smallest at one of these pairs. If no segments overlap in depth, returns the two points that
  /// are nearest in depth.
  ///
  /// \param depths  Depths of all profile points, from depths().
  std::vector<OppositePoints> opposite_points(std::span<const double> depths) const;
  /// Returns the height of each profile point: its coordinate along the direction `up` of the
  /// section. The points of the low profile come first.
  std::vector<double> heights(const Positions& positions) const {
    return coordinates(up_, positions);
  }
  /// Returns the depth of each profile point: its coordinate along the direction `inward()` of the
  /// section. The points have the same order as in `heights`.
  std::vector<double> depths(const Positions& positions) const {
    return coordinates(inward_, positions);
  }
  /// Returns the smallest gap (OppositePoints::gap) of pairs of opposite points of the two
  /// profiles; negative if the profiles intersect.
  /// \param heights  heights of all profile points, from heights().
  static double gap(std::span<const OppositePoints> opposite_pairs,
                    std::span<const double> heights);
  /// Returns the smallest gap between the section's low profile and its high profile on a head.
  double gap(const Positions& positions) const;

 private:
  /// A segment between two neighbouring profile points, as indices into `points_`; both indices are
  /// equal for a point without neighbours.
  using Segment = std::array<std::uint32_t, 2>;

  /// Returns the coordinate of each profile point (see `points_`) along a direction.
  std::vector<double> coordinates(const Eigen::Vector3d& direction,
                                  const Positions& positions) const;

  /// all profile points: first those of the low profile, then those of the high profile
  std::vector<EdgePoint> points_;
  std::vector<Segment> low_, high_;  ///< segments of the low and of the high profile
  Eigen::Vector3d up_, inward_;      ///< directions of the section, see GapSection
};

}  // namespace crowdface
