// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/rigid_motion.h"

#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Of a quaternion w + xi + yj + zk of any length.
Matrix3 rotation_of(double w, double x, double y, double z) {
  const double norm = w * w + x * x + y * y + z * z;
  const double f = 2 / norm;
  return {{{1 - f * (y * y + z * z), f * (x * y - w * z), f * (x * z + w * y)},
           {f * (x * y + w * z), 1 - f * (x * x + z * z), f * (y * z - w * x)},
           {f * (x * z - w * y), f * (y * z + w * x), 1 - f * (x * x + y * y)}}};
}

/// The rotation R that makes Σ w b·(R a) largest, for s[i][j] = Σ w a_i b_j: its quaternion is the
/// eigenvector of the largest eigenvalue of Horn's matrix.
Matrix3 best_turn(const Matrix3& s) {
  Eigen::MatrixXd n(4, 4);
  n(0, 0) = s[0][0] + s[1][1] + s[2][2];
  n(1, 1) = s[0][0] - s[1][1] - s[2][2];
  n(2, 2) = s[1][1] - s[0][0] - s[2][2];
  n(3, 3) = s[2][2] - s[0][0] - s[1][1];
  n(0, 1) = n(1, 0) = s[1][2] - s[2][1];
  n(0, 2) = n(2, 0) = s[2][0] - s[0][2];
  n(0, 3) = n(3, 0) = s[0][1] - s[1][0];
  n(1, 2) = n(2, 1) = s[0][1] + s[1][0];
  n(1, 3) = n(3, 1) = s[2][0] + s[0][2];
  n(2, 3) = n(3, 2) = s[1][2] + s[2][1];
  const Eigen::MatrixXd vectors = symmetric_eigen(n).vectors;
  return rotation_of(vectors(0, 0), vectors(1, 0), vectors(2, 0), vectors(3, 0));
}

}  // namespace

Eigen::Vector3d RigidMotion::turn(const Eigen::Vector3d& direction) const {
  Eigen::Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    result(static_cast<Index>(i)) =
        scale * (rotation[i][0] * direction.x() + rotation[i][1] * direction.y() +
                 rotation[i][2] * direction.z());
  }
  return result;
}

Eigen::Vector3d RigidMotion::undo(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d moved = (point - to) / scale;
  Eigen::Vector3d result = from;
  for (std::size_t i = 0; i < 3; ++i) {
    result(static_cast<Index>(i)) +=
        rotation[0][i] * moved.x() + rotation[1][i] * moved.y() + rotation[2][i] * moved.z();
  }
  return result;
}

Eigen::Vector3d RigidMotion::apply(const Eigen::Vector3d& point) const {
  return to + turn(point - from);
}

RigidMotion nudged(const RigidMotion& motion, const Eigen::Vector3d& pivot,
                   const Eigen::Vector3d& shift, const Eigen::Vector3d& turn, double growth) {
  RigidMotion result = motion;
  RigidMotion turned;
  turned.rotation = rotation_of(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
  turned.scale = 1 + growth;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      result.rotation[r][c] = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        result.rotation[r][c] += turned.rotation[r][k] * motion.rotation[k][c];
      }
    }
  }
  result.scale = motion.scale * turned.scale;
  result.to = pivot + shift + turned.turn(motion.to - pivot);
  return result;
}

RigidMotion fit_rigid_motion(const Positions& from, const Positions& to,
                             std::span<const std::uint32_t> vertices,
                             std::span<const double> weights) {
  RigidMotion motion;
  double total = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double w = weights[i];
    total += w;
    for (Index c = 0; c < 3; ++c) {
      motion.from(c) += w * from(vertices[i], c);
      motion.to(c) += w * to(vertices[i], c);
    }
  }
  motion.from /= total;
  motion.to /= total;
  Matrix3 s{};
  double variance = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double w = weights[i];
    double a[3], b[3];
    for (Index c = 0; c < 3; ++c) {
      a[c] = from(vertices[i], c) - motion.from(c);
      b[c] = to(vertices[i], c) - motion.to(c);
    }
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) s[r][c] += w * a[r] * b[c];
    }
    variance += w * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  }
  motion.rotation = best_turn(s);
  double along = 0;  // trace(Rᵀ Σ w b aᵀ)
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) along += motion.rotation[r][c] * s[c][r];
  }
  if (variance > 0 && along > 0) motion.scale = along / variance;
  return motion;
}

}  // namespace crowdface
