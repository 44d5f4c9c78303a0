// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include <Eigen/Core>

namespace crowdface::synth {

/// A smooth displacement of part of the head: (1 − r²)³ · (shift + stretch · (p − centre)), r being
/// the distance from the centre in radii. Its mirror image at −x goes with it unless the centre
/// lies in the middle.
struct Pull {
  Eigen::Vector3d centre, radii, shift, stretch;
};

/// One independent measure of a head: how it moves the skin for a value of 1 (one standard
/// deviation), and how much of its average hangs on the person.
struct Measure {
  std::string_view name;
  double male, aged, build;  ///< the average's change for each
  double spread;             ///< of what is drawn around it
  Pull pull;
};
std::span<const Measure> measures();

}  // namespace crowdface::synth
