// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/heads_on_body.h"

#include "crowdface/mesh/mirror_map.h"

namespace crowdface {

std::optional<RigidMotion> HeadsOnBody::turning(const Recipe& recipe,
                                                const MirrorPlane* plane) const {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (const SourceWeight& share : target_shares(recipe)) {
    turn += share.weight * heads[static_cast<std::size_t>(share.head)].turn;
  }
  if (turn.isZero(0)) return std::nullopt;
  if (recipe.asymmetry != 1) {
    const Eigen::Vector3d& n = plane->normal;
    const Eigen::Vector3d image = 2 * n.dot(turn) * n - turn;  // of an axial vector
    turn += mirror_share(recipe.asymmetry, false) * (image - turn);
  }
  return nudged({}, middle, Eigen::Vector3d::Zero(), turn, 0);
}

}  // namespace crowdface
