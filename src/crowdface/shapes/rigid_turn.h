// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// A rigid part of the template: an eyeball, or the teeth of a jaw.
struct RigidPart {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> fitted;  ///< the subset of `vertices` used in fits
  std::vector<double> ones;           ///< #fitted
  /// centre of rotation: for an eyeball its centre, for teeth their mean
  Eigen::Vector3d middle;
};

/// The motion of a rigid part in a shape, without the influence of the mesh on which it was
/// measured: find_turn removes the local rotation and stretch of that mesh relative to the
/// template, and carry_turn applies the rotation and stretch of another face.
struct RigidTurn {
  /// unit quaternion (w, x, y, z); rotation about the middle
  std::array<double, 4> quaternion = {1, 0, 0, 0};
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< translation of the middle
  /// #rows: residual displacement beyond rotation and translation
  std::vector<Eigen::Vector3d> rests;
};

/// The position of a rigid part on a face.
struct PlacedPart {
  PlacedPart(const RigidPart& part, const Positions& neutral, const Positions& mesh,
             const RigidMotion& whole, const Eigen::Matrix3d& map);

  Eigen::Vector3d middle;
  const Positions& mesh;
  const RigidMotion& whole;    ///< motion from the template to the face
  const Eigen::Matrix3d& map;  ///< mean linear map of the part's moved vertices
};

/// Measures the motion of a rigid part in a shape of a mesh, and expresses it on the template.
///
/// \param vertices  #rows: vertices of the part that the shape moves.
/// \param rows      Their rows in `moves`.
/// \param moves     Displacements of the shape.
RigidTurn find_turn(const RigidPart& part, const PlacedPart& placed,
                    std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> rows,
                    const Positions& moves);

/// Returns the weighted mean of several sets' motions.
RigidTurn mean_turn(std::span<const RigidTurn> turns, std::span<const SetShare> shares);

/// Transfers a motion to a part of a face: writes the part's displacements to `rows` of `moves`.
void carry_turn(const RigidTurn& turn, const PlacedPart& placed,
                std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> rows,
                Positions& moves);

}  // namespace crowdface
