// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Measures how unusual a face is among the input heads: the face's Mahalanobis distance (1936)
/// from the heads' mean, divided by the distance that a new head typically has. A small number of
/// heads does not determine the variance in every direction, so a tenth of the mean variance is
/// added in every direction (as in probabilistic PCA, Tipping & Bishop 1999). The typical distance
/// is the root mean square of the heads' Mahalanobis distances, where each head is measured against
/// all other heads.
class Plausibility {
 public:
  explicit Plausibility(const FaceSpace& space);
  /// Returns how unusual a face is: the face's Mahalanobis distance divided by the typical
  /// distance. A larger score is less plausible. 1: as unusual as a typical real head.
  double score(const FaceSpace::Point& point) const;

 private:
  /// The data that determine the Mahalanobis distance from the mean of a set of heads: of all
  /// heads, or of all heads except one.
  struct Metric {
    std::vector<double> mean;  ///< mean of the points of the heads, #D
    /// for each head: the head's point minus the mean, #D
    std::vector<std::vector<double>> head_offsets;
    /// Cholesky factor of ridge·(H − 1)·I + Y Yᵀ, where H is the number of heads and Y has one row
    /// of `head_offsets` per head
    std::vector<std::vector<double>> cholesky_factor;
    double ridge = 1;  ///< variance that is added in every direction
  };
  /// Returns the metric of all heads, or of all heads except one.
  ///
  /// \param heads          The heads, then their mirror images if faces may be mirrored.
  /// \param head_count     Number of heads without mirror images.
  /// \param left_out_head  Head that is left out together with its mirror image; −1: no head is
  ///                       left out.
  static Metric metric_without(const std::vector<Eigen::VectorXf>& heads, Index head_count,
                               Index left_out_head);
  static double squared_distance(const Metric& metric, const Eigen::VectorXf& point);

  Metric metric_;  ///< metric computed from all heads, with none left out
  /// the Mahalanobis distance from the mean that a new head typically has
  double typical_distance_ = 1;
};

}  // namespace crowdface
