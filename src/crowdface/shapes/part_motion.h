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
  /// the subset of `vertices` to which the part's motion is fitted
  std::vector<std::uint32_t> fitted_vertices;
  /// all 1, one per fitted vertex; for fit_rigid_motion
  std::vector<double> equal_weights;
  /// centre of rotation: the centre of an eyeball, or the mean of the teeth
  Eigen::Vector3d centre;
};

/// The motion of a rigid part in a shape, relative to the template. find_part_motion measures the
/// motion on a mesh, and removes the local rotation and stretch of this mesh. transfer_part_motion
/// applies the local rotation and stretch of another face.
struct PartMotion {
  /// unit quaternion (w, x, y, z) of the rotation about the centre
  std::array<double, 4> quaternion = {1, 0, 0, 0};
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< translation of the centre
  /// one per vertex that the shape moves: the part of its displacement that rotation and
  /// translation do not explain
  std::vector<Eigen::Vector3d> residuals;
};

/// A rigid part on a face at rest, with the motion and the local linear map from the template to
/// the face.
struct PlacedPart {
  /// \param neutral  Template at rest, #V by 3.
  /// \param mesh     The face at rest, #V by 3.
  PlacedPart(const RigidPart& part, const Positions& neutral, const Positions& mesh,
             const RigidMotion& face_motion, const Eigen::Matrix3d& map);

  Eigen::Vector3d centre;          ///< RigidPart::centre, moved to the face
  const Positions& mesh;           ///< positions of the whole face at rest, #V by 3
  const RigidMotion& face_motion;  ///< motion from the template to the face
  /// The local linear map from the template to the face: its mean over some vertices of the part.
  /// These are the vertices that the shape moves.
  const Eigen::Matrix3d& map;
};

/// Measures how a shape moves a rigid part of a mesh, and transforms this motion to the template.
///
/// \param vertices  Those vertices of the part that are moved by the shape.
/// \param rows      Row of each of `vertices` in `moves`.
/// \param moves     Displacements of the shape.
PartMotion find_part_motion(const RigidPart& part, const PlacedPart& placed,
                            std::span<const std::uint32_t> vertices,
                            std::span<const std::uint32_t> rows, const Positions& moves);

/// Returns the weighted mean of the part's motions in several sets of shapes.
PartMotion mean_part_motion(std::span<const PartMotion> motions,
                            std::span<const ShapeSetShare> shares);

/// Transfers the motion of a rigid part to a face: for each i, writes the displacement of vertex
/// `vertices[i]` to row `rows[i]` of `moves`.
///
/// \param part_motion  The motion on the template.
/// \param placed  The part on the face at rest.
void transfer_part_motion(const PartMotion& part_motion, const PlacedPart& placed,
                          std::span<const std::uint32_t> vertices,
                          std::span<const std::uint32_t> rows, Positions& moves);

}  // namespace crowdface
