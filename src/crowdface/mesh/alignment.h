// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// x ↦ scale · R · x + t.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double scale = 1;

  /// Angle of the rotation in degrees, in [0, 180].
  double angle_degrees() const;
  Positions apply(const Positions& positions) const;
};

/// The rotation R that makes trace(Rᵀ M) largest: of all rotations the one that carries b_i nearest to
/// a_i for M = Σ a_i b_iᵀ (Kabsch 1976; never a reflection).
Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& covariance);

enum class ScaleFit { kRigid, kUniform };

/// The motion that carries `from` nearest to `to` in the least-squares sense, row by row.
/// \param weights  #V, not negative; empty: all rows count the same.
/// Source: Umeyama 1991, "Least-squares estimation of transformation parameters between two point
/// patterns".
/// \throws BrokenPrecondition if the sizes differ; InvalidInput if fewer than three rows are given.
Similarity fit_similarity(const Positions& from, const Positions& to, ScaleFit scale,
                          const Eigen::VectorXd& weights = {});

}  // namespace crowdface
