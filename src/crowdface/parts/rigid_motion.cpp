// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/rigid_motion.h"

#include "crowdface/mesh/vector3.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

/// Returns the rotation of a quaternion w + xi + yj + zk of any length.
Eigen::Matrix3d rotation_of(double w, double x, double y, double z) {
  const double norm = w * w + x * x + y * y + z * z;
  const double f = 2 / norm;
  return Eigen::Matrix3d{{1 - f * (y * y + z * z), f * (x * y - w * z), f * (x * z + w * y)},
                         {f * (x * y + w * z), 1 - f * (x * x + z * z), f * (y * z - w * x)},
                         {f * (x * z - w * y), f * (y * z + w * x), 1 - f * (x * x + y * y)}};
}

/// Returns the rotation R that maximises Σ w b·(R a) over pairs of vectors (a, b) with weights w,
/// given s = Σ w a bᵀ. The quaternion of R is the eigenvector of the largest eigenvalue of Horn's
/// matrix.
Eigen::Matrix3d horn_rotation(const Eigen::Matrix3d& s) {
  Eigen::MatrixXd n(4, 4);
  n(0, 0) = s(0, 0) + s(1, 1) + s(2, 2);
  n(1, 1) = s(0, 0) - s(1, 1) - s(2, 2);
  n(2, 2) = s(1, 1) - s(0, 0) - s(2, 2);
  n(3, 3) = s(2, 2) - s(0, 0) - s(1, 1);
  n(0, 1) = n(1, 0) = s(1, 2) - s(2, 1);
  n(0, 2) = n(2, 0) = s(2, 0) - s(0, 2);
  n(0, 3) = n(3, 0) = s(0, 1) - s(1, 0);
  n(1, 2) = n(2, 1) = s(0, 1) + s(1, 0);
  n(1, 3) = n(3, 1) = s(2, 0) + s(0, 2);
  n(2, 3) = n(3, 2) = s(1, 2) + s(2, 1);
  const Eigen::MatrixXd vectors = symmetric_eigen(n).eigenvectors;
  return rotation_of(vectors(0, 0), vectors(1, 0), vectors(2, 0), vectors(3, 0));
}

}  // namespace

Eigen::Vector3d RigidMotion::apply_to_direction(const Eigen::Vector3d& direction) const {
  return scale * multiply3(rotation, direction);
}

Eigen::Vector3d RigidMotion::apply_inverse(const Eigen::Vector3d& point) const {
  return pivot + multiply3(rotation.transpose(), (point - moved_pivot) / scale);
}

Eigen::Vector3d RigidMotion::apply(const Eigen::Vector3d& point) const {
  return moved_pivot + apply_to_direction(point - pivot);
}

void move_rows(const RigidMotion& motion, Positions& positions) {
  for (Index i = 0; i < positions.rows(); ++i) {
    positions.row(i) = motion.apply(row3(positions, i)).transpose();
  }
}

RigidMotion inverse(const RigidMotion& motion) {
  return {.rotation = motion.rotation.transpose(),
          .scale = 1 / motion.scale,
          .pivot = motion.moved_pivot,
          .moved_pivot = motion.pivot};
}

RigidMotion nudged(const RigidMotion& motion, const Eigen::Vector3d& pivot,
                   const Eigen::Vector3d& shift, const Eigen::Vector3d& rotation_vector,
                   double growth) {
  RigidMotion result = motion;
  RigidMotion turned;
  turned.rotation =
      rotation_of(1, rotation_vector.x() / 2, rotation_vector.y() / 2, rotation_vector.z() / 2);
  turned.scale = 1 + growth;
  for (Index c = 0; c < 3; ++c) {
    result.rotation.col(c) = multiply3(turned.rotation, motion.rotation.col(c));
  }
  result.scale = motion.scale * turned.scale;
  result.moved_pivot = pivot + shift + turned.apply_to_direction(motion.moved_pivot - pivot);
  return result;
}

RigidMotion fit_rigid_motion(const Positions& source, const Positions& target,
                             std::span<const std::uint32_t> vertices,
                             std::span<const double> weights) {
  RigidMotion motion;
  double total = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    total += weights[i];
    motion.pivot += weights[i] * row3(source, vertices[i]);
    motion.moved_pivot += weights[i] * row3(target, vertices[i]);
  }
  motion.pivot /= total;
  motion.moved_pivot /= total;
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  double variance = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d a = row3(source, vertices[i]) - motion.pivot;
    const Eigen::Vector3d b = row3(target, vertices[i]) - motion.moved_pivot;
    // round this product first, so that the order of operations is fixed
    const Eigen::Vector3d weighted = weights[i] * a;
    s += weighted * b.transpose();
    variance += weights[i] * a.squaredNorm();
  }
  motion.rotation = horn_rotation(s);
  double along = 0;  // trace(Rᵀ Σ w b aᵀ)
  for (Index r = 0; r < 3; ++r) {
    for (Index c = 0; c < 3; ++c) along += motion.rotation(r, c) * s(c, r);
  }
  if (variance > 0 && along > 0) motion.scale = along / variance;
  return motion;
}

}  // namespace crowdface
