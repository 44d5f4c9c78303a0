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
  /// \param around  The centres. If there are none, nothing changes.
  /// \param cell    Cell size of the grid over which vectors are averaged.
  /// \param whole   Up to this distance from a centre, the average replaces a vector completely.
  /// \param none    From this distance on, a vector does not change. Between `whole` and `none` the
  ///                effect fades.
  SmoothedVectors(std::vector<Eigen::Vector3d> around, double cell, double whole, double none);

  /// Returns whether a sample at this position can affect the result.
  bool affects(const Eigen::Vector3d& place) const;

  struct Sample {
    std::uint32_t number;  ///< an index of the caller's choice
    Eigen::Vector3d place, value;
  };
  struct Change {
    std::uint32_t number;
    Eigen::Vector3d by;
  };
  /// Returns the changes of the samples nearer than `none` to a centre.
  ///
  /// \param samples  Only samples at positions for which `affects` is true.
  std::vector<Change> changes(std::span<const Sample> samples) const;

 private:
  bool in_reach(const Eigen::Vector3d& place, double reach) const;
  double distance(const Eigen::Vector3d& place) const;

  std::vector<Eigen::Vector3d> around_;
  Eigen::AlignedBox3d box_;  ///< bounding box of the centres
  double cell_, whole_, none_;
};

}  // namespace crowdface
