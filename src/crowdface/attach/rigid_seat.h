// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/attach/skin_gaps.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/socket.h"

namespace crowdface {

/// Where something stiff sits on the skin. It moves by the best turn, shift and scale of the skin near
/// it, and is then shifted, turned and scaled a little further, as far as that keeps it off the skin.
class RigidSeat {
 public:
  /// \param skin, points, gaps  must outlive this object; points #P by 3, beside the fitted mesh.
  RigidSeat(const FittedSkin& skin, const Positions& points, const SkinGaps& gaps);

  /// The points on a face. \param normals  of the face, from FittedSkin::normals
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
  double radius_ = 1;  ///< root mean square about the middle
};

}  // namespace crowdface
