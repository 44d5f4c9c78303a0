// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "head_models/synth/measures.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {

/// What a head's measures hang together with.
struct Person {
  double male = 0;   ///< −1 female … 1 male
  double age = 40;   ///< years, 18 … 78
  double build = 0;  ///< standard normal, cut at ±2: slight … heavy

  /// −1 … 1.9: 40 years is 0, 60 is 1.
  double aged() const { return (age - 40) / 20; }
};
/// Of two successive heads (indices 2k and 2k + 1) one is female and one male; of five (from 5k on)
/// each is of another fifth of the ages.
Person draw_person(std::uint64_t seed, std::uint64_t index);

/// Who a head is: its person and, drawn around what that person's are on average, its measures.
class Identity {
 public:
  Identity(std::uint64_t seed, std::uint64_t index);
  /// The average head's: nothing is drawn, no point moves.
  static Identity average() { return Identity(); }

  /// Carries a point of the average head to this one.
  Eigen::Vector3d deform(const Eigen::Vector3d& point) const;

  const Person& person() const { return person_; }
  std::uint64_t seed() const { return seed_; }
  std::uint64_t index() const { return index_; }

 private:
  Identity() : lopsided_(0, 5.5) {}

  std::uint64_t seed_ = 0, index_ = 0;
  Person person_;
  std::vector<Pull> pulls_;
  Eigen::Vector3d scale_{1, 1, 1};
  double face_length_ = 0;
  double unevenness_ = 0;  ///< cm
  SmoothNoise lopsided_;   ///< nobody's left is quite like their right
};

}  // namespace crowdface::synth
