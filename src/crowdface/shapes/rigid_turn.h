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

/// A rigid part of the template: an eyeball, a jaw's teeth.
struct RigidPart {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> fitted;  ///< some of them
  std::vector<double> ones;           ///< #fitted
  Eigen::Vector3d middle;             ///< of an eyeball: its centre
};

/// How a shape moves a rigid part of a mesh, measured on the template: what the face is turned and
/// stretched against it is taken out, and put in again on another.
struct RigidTurn {
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< unit; about the middle
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< of the middle
  std::vector<Eigen::Vector3d> rests;               ///< #rows: of the moves, beside that
};

/// A face at a rigid part.
struct PlacedPart {
  PlacedPart(const RigidPart& part, const Positions& neutral, const Positions& mesh,
             const RigidMotion& whole, const Eigen::Matrix3d& map);

  Eigen::Vector3d middle;
  const Positions& mesh;
  const RigidMotion& whole;    ///< from the template to the face
  const Eigen::Matrix3d& map;  ///< of the skin at the part
};

/// \param vertices  #rows, of the part, that the shape moves
/// \param rows      their rows among the moves
/// \param moves     the shape's
RigidTurn find_turn(const RigidPart& part, const PlacedPart& placed,
                    std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> rows,
                    const Positions& moves);

/// Between those of several sets.
RigidTurn mean_turn(std::span<const RigidTurn> turns, std::span<const SetShare> shares);

/// Writes the rows of `moves`.
void carry_turn(const RigidTurn& turn, const PlacedPart& placed,
                std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> rows,
                Positions& moves);

}  // namespace crowdface
