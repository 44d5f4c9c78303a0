// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/head_rotations.h"

#include <algorithm>
#include <numeric>

#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// Moves the centroid of the points to the origin, then rotates the points about the origin.
Positions turned(const Positions& points, const Eigen::Matrix3d& rotation) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (Index i = 0; i < points.rows(); ++i) middle += row3(points, i);
  middle /= static_cast<double>(points.rows());
  Positions result(points.rows(), 3);
  for (Index i = 0; i < points.rows(); ++i) {
    result.row(i) = multiply3(rotation, row3(points, i) - middle).transpose();
  }
  return result;
}

/// The median of each coordinate over all heads. A few turned heads have little effect on a median.
Positions median(const std::vector<Positions>& heads) {
  Positions result(heads.front().rows(), 3);
  std::vector<double> values(heads.size());
  for (Index i = 0; i < result.size(); ++i) {
    for (std::size_t h = 0; h < heads.size(); ++h) values[h] = heads[h].data()[i];
    result.data()[i] = nth_smallest(values, values.size() / 2);
  }
  return result;
}

}  // namespace

RigidMotion head_motion(const Positions& from, const Positions& to) {
  constexpr int kRounds = 10;
  // The weight of a point in the next round is the inverse of its distance from the corresponding
  // point of the other head. Distances below kMinDistance times the mean distance count as
  // kMinDistance times the mean distance.
  constexpr double kMinDistance = 0.1;
  std::vector<std::uint32_t> all(static_cast<std::size_t>(from.rows()));
  std::iota(all.begin(), all.end(), 0U);
  std::vector<double> weights(all.size(), 1.0);
  RigidMotion motion;
  for (int round = 0; round < kRounds; ++round) {
    motion = fit_rigid_motion(from, to, all, weights);
    motion.scale = 1;
    double sum = 0;
    for (const std::uint32_t i : all) {
      weights[i] = (motion.apply(row3(from, i)) - row3(to, i)).norm();
      sum += weights[i];
    }
    const double least = kMinDistance * sum / static_cast<double>(all.size());
    if (!(least > 0)) break;
    for (double& weight : weights) weight = 1 / std::max(weight, least);
  }
  return motion;
}

Eigen::Matrix3d pose_difference(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& across) {
  // Ignore small rotations: between heads of different shape, the fit finds a rotation even if both
  // heads have the same pose. Among 24 MakeHuman, 24 synthetic and 16 ICT heads, this rotation is
  // at most 4.3 degrees about the axis through the ears and at most 0.8 degrees about other axes.
  constexpr double kInclined = 0.10481555856608242;    // 2 tan(6°/2)
  constexpr double kAsymmetric = 0.03491012985643517;  // 2 tan(2°/2)
  const Eigen::Vector3d turn = rotation_vector(rotation);
  Eigen::Vector3d inclined = turn.dot(across) * across, rest = turn - inclined;
  if (inclined.norm() <= kInclined) inclined.setZero();
  if (rest.norm() <= kAsymmetric) rest.setZero();
  if (inclined.isZero(0) && rest.isZero(0)) return Eigen::Matrix3d::Identity();
  return nudged({}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), inclined + rest, 0).rotation;
}

std::vector<Eigen::Matrix3d> rotations_to_median(const std::vector<Positions>& heads,
                                                 const Eigen::Vector3d& across) {
  constexpr int kRounds = 10;  // the median moves as heads turn
  std::vector<Eigen::Matrix3d> rotations(heads.size(), Eigen::Matrix3d::Identity());
  if (heads.size() < 3) return rotations;  // with two heads, either one may be turned
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Positions> placed;
    for (std::size_t h = 0; h < heads.size(); ++h) {
      placed.push_back(turned(heads[h], rotations[h]));
    }
    const Positions middle = median(placed);
    const std::vector<Eigen::Matrix3d> before = rotations;
    for (std::size_t h = 0; h < heads.size(); ++h) {
      rotations[h] = pose_difference(head_motion(heads[h], middle).rotation, across);
    }
    if (rotations == before) break;
  }
  return rotations;
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const double scale = 2 / (1 + rotation(0, 0) + rotation(1, 1) + rotation(2, 2));
  return scale * Eigen::Vector3d(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                                 rotation(1, 0) - rotation(0, 1));
}

}  // namespace crowdface
