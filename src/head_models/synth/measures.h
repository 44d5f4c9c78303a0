// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include <Eigen/Core>

namespace crowdface::synth {

/// A smooth local displacement: (1 − r²)³ · (shift + stretch · (p − centre)) for r < 1, where r is
/// the distance from the centre relative to the radii. The displacement is mirrored at x = 0 unless
/// the centre has x = 0. Lengths in cm.
struct LocalDisplacement {
  /// The parameters of the formula in the comment of LocalDisplacement. `centre`, `radii` and
  /// `shift` are in cm; `stretch` has no unit.
  Eigen::Vector3d centre, radii, shift, stretch;
};

/// A property of a head, such as the length of the nose. The value of a measure is
///
///     maleness_effect · Person::maleness + age_effect · Person::scaled_age()
///     + build_effect · Person::build + spread · N(0, 1) + mean
struct Measure {
  std::string_view name;
  double maleness_effect, age_effect, build_effect;  ///< factors of the formula above
  double spread;                   ///< standard deviation of the measure's random part
  LocalDisplacement displacement;  ///< displacement of the skin if the measure has the value 1
  double mean = 0;                 ///< value of the measure for a person with average attributes
};
/// Returns all measures.
std::span<const Measure> measures();

}  // namespace crowdface::synth
