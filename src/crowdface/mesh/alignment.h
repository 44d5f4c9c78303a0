// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The similarity transform x ↦ scale · R · x + t.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< the rotation R
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< the translation t
  double scale = 1;

  /// Rotation angle in degrees, in [0, 180].
  double angle_degrees() const;
  /// The positions after the transform.
  Positions apply(const Eigen::Ref<const Positions>& positions) const;
};

/// Returns the rotation R that maximises trace(Rᵀ M) for M = `covariance`. For M = Σ a_i b_iᵀ, R is
/// the rotation that minimises Σ |a_i − R b_i|². R is never a reflection. Source: Kabsch 1976.
Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& covariance);

/// Whether fit_similarity keeps the scale 1 (kRigid) or also fits the scale (kUniform).
enum class ScaleFit { kRigid, kUniform };

/// Finds the transform that brings each row of `from` closest to the row of `to` with the same
/// index, in the least-squares sense.
/// \param weights  one weight per row, not negative; if empty, all rows have the same weight.
/// Source: Umeyama 1991, "Least-squares estimation of transformation parameters between two point
/// patterns".
/// \throws BrokenPrecondition if the sizes differ; InvalidInput if there are fewer than three rows.
Similarity fit_similarity(const Eigen::Ref<const Positions>& from,
                          const Eigen::Ref<const Positions>& to, ScaleFit scale,
                          const Eigen::VectorXd& weights = {});

}  // namespace crowdface
