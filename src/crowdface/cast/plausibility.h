// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// How unusual a face is among the input heads: its Mahalanobis distance (1936) from their mean,
/// where 1 is as far as a new head would typically be. Few heads do not tell the variance of every
/// direction, so a tenth of their mean variance is added to each (as probabilistic principal
/// components do, Tipping & Bishop 1999); "a new head" is each of them measured with the others
/// alone.
class Plausibility {
 public:
  explicit Plausibility(const FaceSpace& space);
  double score(const FaceSpace::Point& point) const;

 private:
  /// The distance's square by all heads, or by all but one.
  struct Metric {
    std::vector<double> mean;                  ///< #D
    std::vector<std::vector<double>> offsets;  ///< #heads − mean, #D each
    std::vector<std::vector<double>> lower;    ///< Cholesky factor of ridge·(H − 1)·I + Y Yᵀ
    double ridge = 1;
  };
  /// \param heads  of the heads, and then of their mirror images, where faces may be mirrored.
  static Metric metric_without(const std::vector<Eigen::VectorXf>& heads, Index count_of_heads,
                               Index left_out);
  static double squared(const Metric& metric, const Eigen::VectorXf& at);

  Metric metric_;
  double unit_ = 1;
};

}  // namespace crowdface
