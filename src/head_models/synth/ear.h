// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// A place on the average ear, side x > 0, for ring and core addresses.
Eigen::Vector3d ear_point(const Address& address);

/// The middle of the ear on the head's side.
inline Eigen::Vector3d ear_centre() {
  return {6.9, -2.55, -1.0};
}

}  // namespace crowdface::synth
