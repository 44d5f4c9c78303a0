// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Vectors at scattered places, evened out near some of them.
class EvenedField {
 public:
  /// \param around  the places near which it is evened out; none: nowhere
  /// \param cell    over which
  /// \param whole   so near to those a vector becomes the mean around it,
  /// \param none    and so far from them it stays
  EvenedField(std::vector<Eigen::Vector3d> around, double cell, double whole, double none);

  /// Whether what lies at a place may have a say.
  bool hears(const Eigen::Vector3d& place) const;

  struct Sample {
    std::uint32_t number;  ///< the caller's
    Eigen::Vector3d place, value;
  };
  struct Change {
    std::uint32_t number;
    Eigen::Vector3d by;
  };
  /// What becomes of samples that are heard; of those which stay nothing.
  std::vector<Change> changes(std::span<const Sample> samples) const;

 private:
  bool in_reach(const Eigen::Vector3d& place, double reach) const;
  double distance(const Eigen::Vector3d& place) const;

  std::vector<Eigen::Vector3d> around_;
  Eigen::AlignedBox3d box_;  ///< of those
  double cell_, whole_, none_;
};

}  // namespace crowdface
