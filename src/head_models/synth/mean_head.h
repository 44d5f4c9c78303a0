// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// A place on the average head, in centimetres: +Y up, looking along +Z, eyes at y = 0.
struct SkinPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit, outward
  double relief = 1;       ///< how much fine relief shows here: 0 on eyeballs and inside openings
};

SkinPoint mean_skin(const Address& address);

/// The same where the eyeballs are pieces of their own: behind the lids' edges the skin does not run
/// over the ball to a pupil but turns back around it, as a pocket.
SkinPoint mean_skin_with_sockets(const Address& address);

}  // namespace crowdface::synth
