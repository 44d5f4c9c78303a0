// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/attach/skin_gaps.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/socket.h"

namespace crowdface {

/// Places a rigid attachment on a face. First, the attachment moves by the rotation, translation
/// and scale that best fit the motion of the nearby skin. Then a few small rigid motions reduce the
/// depth by which the attachment penetrates the skin.
class RigidPlacement {
 public:
  /// \param skin    Must outlive this object.
  /// \param points  #P by 3, on the fitted mesh; must outlive this object.
  /// \param gaps    Distances of the points from the skin; must outlive this object.
  RigidPlacement(const FittedSkin& skin, const Positions& points, const SkinGaps& gaps);

  /// Returns the positions, #P by 3, of the attachment's points on the face `face`.
  ///
  /// \param face     #V by 3.
  /// \param normals  Normals of the face, from FittedSkin::normals.
  Positions place(const Positions& face, const Positions& normals) const;

 private:
  /// Returns `motion` followed by one least-squares step that moves the attachment out of the skin.
  /// \param violations  vertices that are too near to the skin after `motion`
  RigidMotion push_out_of_skin(const RigidMotion& motion,
                               const std::vector<SkinGaps::Violation>& violations) const;
  /// Returns the points of the attachment after the motion, #P by 3.
  Positions moved_points(const RigidMotion& motion) const;

  const FittedSkin& skin_;
  const Positions& points_;  ///< #P by 3: the attachment's vertices on the fitted mesh
  /// distances of the attachment's vertices from the skin of the fitted mesh
  const SkinGaps& gaps_;
  Socket socket_;  ///< the skin near the attachment, whose motion the attachment follows
  /// mean of the attachment's vertices on the fitted mesh
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double radius_ = 1;  ///< root mean square distance of the attachment's vertices from `centre_`
};

}  // namespace crowdface
