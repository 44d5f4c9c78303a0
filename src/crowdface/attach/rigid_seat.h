// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/attach/skin_gaps.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/socket.h"

namespace crowdface {

/// Places a rigid attachment on a face. The attachment first gets the best rotation, translation
/// and scale of the skin near it. A few small rigid motions then reduce how far it penetrates the
/// skin.
class RigidSeat {
 public:
  /// \param skin    Must outlive this object.
  /// \param points  #P by 3, on the fitted mesh; must outlive this object.
  /// \param gaps    Distances of the points from the skin; must outlive this object.
  RigidSeat(const FittedSkin& skin, const Positions& points, const SkinGaps& gaps);

  /// Returns the points on a face, #P by 3.
  ///
  /// \param face     #V by 3.
  /// \param normals  Normals of the face, from FittedSkin::normals.
  Positions seat(const Positions& face, const Positions& normals) const;

 private:
  RigidMotion nudge_off(const RigidMotion& motion,
                        const std::vector<SkinGaps::Missing>& missing) const;
  Positions moved(const RigidMotion& motion) const;

  const FittedSkin& skin_;
  const Positions& points_;
  const SkinGaps& gaps_;
  Socket socket_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double radius_ = 1;  ///< root mean square distance of the points from `middle_`
};

}  // namespace crowdface
