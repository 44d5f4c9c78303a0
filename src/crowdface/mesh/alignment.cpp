// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/alignment.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

struct Turn {
  Eigen::Matrix3d rotation;
  double trace = 0;  ///< trace of Rᵀ M, where R is `rotation` and M is the covariance
};

Turn turn_from(const Eigen::Matrix3d& covariance) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs(2) = -1;
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(),
          svd.singularValues().dot(signs)};
}

}  // namespace

double Similarity::angle_degrees() const {
  // Compute the angle from the skew-symmetric part (sine) and the trace (cosine), because acos of
  // the trace alone is inaccurate for small angles.
  const double sine = 0.5 * std::sqrt(std::pow(rotation(2, 1) - rotation(1, 2), 2) +
                                      std::pow(rotation(0, 2) - rotation(2, 0), 2) +
                                      std::pow(rotation(1, 0) - rotation(0, 1), 2));
  const double cosine = 0.5 * (rotation.trace() - 1);
  return std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

Positions Similarity::apply(const Eigen::Ref<const Positions>& positions) const {
  const Eigen::Matrix3d linear = scale * rotation;
  Positions result(positions.rows(), 3);
  for (Index i = 0; i < positions.rows(); ++i) {
    for (Index c = 0; c < 3; ++c) {
      result(i, c) = linear(c, 0) * positions(i, 0) + linear(c, 1) * positions(i, 1) +
                     linear(c, 2) * positions(i, 2) + translation(c);
    }
  }
  return result;
}

Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& covariance) {
  return turn_from(covariance).rotation;
}

Similarity fit_similarity(const Eigen::Ref<const Positions>& from,
                          const Eigen::Ref<const Positions>& to, ScaleFit scale,
                          const Eigen::VectorXd& weights) {
  require(from.rows() == to.rows() && (weights.size() == 0 || weights.size() == from.rows()),
          "alignment: ", from.rows(), " points onto ", to.rows(), ", ", weights.size(), " weights");
  if (from.rows() < 3) {
    throw InvalidInput(concat("expected at least 3 points to align, found ", from.rows()));
  }
  const auto weight = [&](Index i) { return weights.size() == 0 ? 1.0 : weights(i); };
  double total = 0;
  Eigen::Vector3d from_mean = Eigen::Vector3d::Zero(), to_mean = Eigen::Vector3d::Zero();
  for (Index i = 0; i < from.rows(); ++i) {
    total += weight(i);
    from_mean += weight(i) * from.row(i).transpose();
    to_mean += weight(i) * to.row(i).transpose();
  }
  from_mean /= total;
  to_mean /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double variance = 0;
  for (Index i = 0; i < from.rows(); ++i) {
    const Eigen::Vector3d a = from.row(i).transpose() - from_mean;
    const Eigen::Vector3d b = to.row(i).transpose() - to_mean;
    covariance += weight(i) * b * a.transpose();
    variance += weight(i) * a.squaredNorm();
  }
  const Turn turn = turn_from(covariance);
  Similarity fit;
  fit.rotation = turn.rotation;
  if (scale == ScaleFit::kUniform && variance > 0) fit.scale = turn.trace / variance;
  fit.translation = to_mean - fit.scale * fit.rotation * from_mean;
  return fit;
}

}  // namespace crowdface
