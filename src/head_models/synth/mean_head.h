// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// A point on the average head in cm: +Y is up, the head faces +Z, the eyes are at y = 0.
struct SkinPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;    ///< unit normal of the skin, which points out of the head
  double relief_weight = 1;  ///< factor on the fine relief: 0 on eyeballs and inside openings
};

/// Returns the point of the average head at a point of the lattice. The skin continues behind the
/// lids, over the eyeball, to the pupil.
SkinPoint mean_skin(const LatticePoint& lattice_point);

/// Like mean_skin, but for heads with separate eyeballs (LooseParts): behind the lids the skin
/// forms a pocket around the eyeball.
SkinPoint mean_skin_with_sockets(const LatticePoint& lattice_point);

}  // namespace crowdface::synth
