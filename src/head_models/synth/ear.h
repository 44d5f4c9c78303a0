// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// Returns the point, in cm, of the average head's ear at x > 0.
/// \param lattice_point  a point in the rings or the core of the ear.
Eigen::Vector3d ear_position(const LatticePoint& lattice_point);

/// Centre of the ear at x > 0, on the side of the head, cm.
inline Eigen::Vector3d ear_centre() {
  return {6.9, -2.55, -1.0};
}

}  // namespace crowdface::synth
