// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace crowdface::synth {

/// Random hills in space, twice continuously differentiable, about −1 … 1: a cubic B-spline over
/// random numbers on a lattice of the given spacing.
class SmoothNoise {
 public:
  SmoothNoise(std::uint64_t key, double spacing) : key_(key), spacing_(spacing) {}
  double at(const Eigen::Vector3d& point) const;

 private:
  std::uint64_t key_;
  double spacing_;
};

/// A well-mixed number from three (Steele, Lea & Flood 2014, "Fast splittable pseudorandom number
/// generators": the finaliser of SplitMix64).
std::uint64_t mix(std::uint64_t a, std::uint64_t b, std::uint64_t c);

}  // namespace crowdface::synth
