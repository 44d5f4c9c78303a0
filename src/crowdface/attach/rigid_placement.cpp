// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/rigid_placement.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/quadratic_program.h"

namespace crowdface {
namespace {

/// The socket of an attachment is the skin within this distance of the attachment. The motion of
/// the socket determines the motion of the attachment. The distance is doubled until the socket has
/// at least kMinSocketVertices vertices.
constexpr double kSocketRadiusMm = 15;
constexpr std::size_t kMinSocketVertices = 12;
/// Maximum number of steps that move the attachment out of the skin.
constexpr int kMaxPushSteps = 8;
/// A least-squares step moves the attachment out of the skin by a small motion. The step minimises
/// the squared remaining violations, with weights that sum to 1, plus the squared unknowns of the
/// motion, each with the weight kMotionWeight.
constexpr double kMotionWeight = 0.02;

}  // namespace

RigidPlacement::RigidPlacement(const FittedSkin& skin, const Positions& points,
                               const SkinGaps& gaps)
    : skin_(skin), points_(points), gaps_(gaps) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(points.rows()));
  if (all.empty()) return;
  std::iota(all.begin(), all.end(), 0U);
  centre_ = centre_of(points, all);
  radius_ = std::max(radius_about(centre_, points, all), skin.units_per_mm());
  const PointGrid grid(points, all);
  const std::size_t fewest = std::min(kMinSocketVertices, skin.vertices().size());
  for (double reach = kSocketRadiusMm * skin.units_per_mm(); socket_.vertices.size() < fewest;
       reach *= 2) {
    socket_ = find_socket(skin.mesh_positions(), grid, skin.vertices(), skin.areas(), reach);
    if (reach > 1e6 * skin.units_per_mm()) break;
  }
}

Positions RigidPlacement::moved_points(const RigidMotion& motion) const {
  Positions result(points_.rows(), 3);
  for (Index p = 0; p < points_.rows(); ++p) {
    result.row(p) = motion.apply(row3(points_, p)).transpose();
  }
  return result;
}

RigidMotion RigidPlacement::push_out_of_skin(
    const RigidMotion& motion, const std::vector<SkinGaps::Violation>& violations) const {
  // Three translations, three rotations and a relative change of scale. All unknowns are lengths:
  // rotations and the change of scale are multiplied by `radius`.
  constexpr std::size_t kUnknowns = 7;
  QuadraticProgram program(kUnknowns);
  const Eigen::Vector3d pivot = motion.apply(centre_);
  const double radius = motion.scale * radius_;
  const double weight = 1 / static_cast<double>(violations.size());
  for (const SkinGaps::Violation& one : violations) {
    const Eigen::Vector3d arm = (motion.apply(row3(points_, one.vertex)) - pivot) / radius;
    const Eigen::Vector3d turned = arm.cross(one.outward_normal);
    const Eigen::Vector3d& n = one.outward_normal;
    program.add_target({n.x(), n.y(), n.z(), turned.x(), turned.y(), turned.z(), arm.dot(n)},
                       one.missing_height, weight);
  }
  for (std::size_t u = 0; u < kUnknowns; ++u) program.add_target(u, 0, kMotionWeight);
  const QuadraticProgram::Vector x = program.solve(0);
  return nudged(motion, pivot, {x[0], x[1], x[2]}, Eigen::Vector3d(x[3], x[4], x[5]) / radius,
                x[6] / radius);
}

Positions RigidPlacement::place(const Positions& face, const Positions& normals) const {
  if (socket_.vertices.size() < 3) return moved_points({});
  RigidMotion motion =
      fit_rigid_motion(skin_.mesh_positions(), face, socket_.vertices, socket_.weights);
  for (int round = 0; round < kMaxPushSteps; ++round) {
    const auto violations = gaps_.violations(face, normals, moved_points(motion));
    if (violations.empty()) break;
    motion = push_out_of_skin(motion, violations);
  }
  return moved_points(motion);
}

}  // namespace crowdface
