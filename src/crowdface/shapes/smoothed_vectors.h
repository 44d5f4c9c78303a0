// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Smooths vectors at scattered positions, near given centres only.
class SmoothedVectors {
 public:
  /// \param centres  If there are no centres, nothing changes.
  /// \param cell    Cell size of the grid over which vectors are averaged.
  /// \param inner_radius  Distance from a centre up to which the average replaces a vector
  ///                      completely.
  /// \param outer_radius  Distance from a centre beyond which vectors do not change. The effect
  ///                      fades between both radii.
  SmoothedVectors(std::vector<Eigen::Vector3d> centres, double cell, double inner_radius,
                  double outer_radius);

  /// Returns whether a sample at this position can affect the result.
  bool affects(const Eigen::Vector3d& position) const;

  /// A vector (`value`) at a position.
  struct Sample {
    std::uint32_t index;  ///< number that identifies the sample in the result of `changes`
    Eigen::Vector3d position, value;
  };
  /// The vector (`displacement`) to add to the value of a sample.
  struct Change {
    std::uint32_t index;  ///< Sample::index of the sample
    Eigen::Vector3d displacement;
  };
  /// Smooths the values of the samples. Returns one change for each sample that is nearer than
  /// `outer_radius` to one of the constructor's `centres`, in the order of the samples.
  ///
  /// \param samples  The samples. `affects` must be true for the position of each sample.
  std::vector<Change> changes(std::span<const Sample> samples) const;

 private:
  /// Returns whether one of the centres may be nearer to `position` than `reach`. The test is fast;
  /// it sometimes returns true although no centre is so near.
  bool may_be_near_centre(const Eigen::Vector3d& position, double reach) const;
  /// Returns the distance to the nearest centre.
  double distance_to_centre(const Eigen::Vector3d& position) const;

  std::vector<Eigen::Vector3d> centres_;
  Eigen::AlignedBox3d box_;  ///< bounding box of the centres
  /// the constructor's parameters `cell`, `inner_radius` and `outer_radius`
  double cell_, inner_radius_, outer_radius_;
};

}  // namespace crowdface
