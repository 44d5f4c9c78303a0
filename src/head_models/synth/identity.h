// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "head_models/synth/measures.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {

/// Attributes of a person. The person's measures (see Measure) are random; their means depend on
/// these attributes.
struct Person {
  double maleness = 0;    ///< −1 (female) … 1 (male)
  double age_years = 40;  ///< years, 18 … 77
  double build = 0;  ///< build of the body, from slight to heavy: standard normal, clamped to ±2

  /// Returns the age in units of 20 years from 40: −1.1 … 1.85.
  double scaled_age() const { return (age_years - 40) / 20; }
};
/// Returns the random person of head `index` of a seed. Persons are stratified. Of two successive
/// heads (2 · n and 2 · n + 1, for any n), one is female and one is male. Of five successive heads
/// (5 · n to 5 · n + 4), each has an age in a different fifth of the range.
Person random_person(std::uint64_t seed, std::uint64_t index);

/// The identity of a head: the attributes of the person, and random values of the person's
/// measures. The mean of each measure depends on the attributes.
class Identity {
 public:
  Identity(std::uint64_t seed, std::uint64_t index);
  /// Returns the identity of the average head: deform() moves no point.
  static Identity average() { return Identity(); }

  /// Maps a point of the average head to this head, cm.
  Eigen::Vector3d deform(const Eigen::Vector3d& point) const;

  const Person& person() const { return person_; }
  std::uint64_t seed() const { return seed_; }
  std::uint64_t index() const { return index_; }

 private:
  Identity() : asymmetry_noise_(0, 5.5) {}

  std::uint64_t seed_ = 0, index_ = 0;
  Person person_;
  /// For each measure: Measure::displacement, multiplied by the person's value of the measure. And
  /// the displacements that make nose and jaw randomly asymmetric.
  std::vector<LocalDisplacement> displacements_;
  Eigen::Vector3d scale_{1, 1, 1};  ///< factors on width, height and depth of the head
  double face_length_ = 0;          ///< relative change of the length of the face below the eyes
  double asymmetry_amplitude_ = 0;  ///< amplitude of asymmetry_noise_, cm
  /// Noise that displaces the left and the right side of the head differently.
  SmoothNoise asymmetry_noise_;
};

}  // namespace crowdface::synth
