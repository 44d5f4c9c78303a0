// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/synth/layout.h"

namespace crowdface::synth {

/// A place on the average head, in centimetres: +Y up, looking along +Z, eyes at y = 0.
struct SkinPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit, outward
  double relief = 1;       ///< how much fine relief shows here: 0 on eyeballs and inside openings
};

SkinPoint mean_skin(const Address& address);

}  // namespace crowdface::synth
