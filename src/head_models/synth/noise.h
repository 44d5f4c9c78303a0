// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace crowdface::synth {

/// Smooth random noise in 3D with values of about −1 … 1: a uniform cubic B-spline (C²) with random
/// coefficients on a lattice.
class SmoothNoise {
 public:
  /// \param key      selects the noise function: different keys give independent noise.
  /// \param spacing  spacing of the lattice, in the unit of the points.
  SmoothNoise(std::uint64_t key, double spacing) : key_(key), spacing_(spacing) {}
  double at(const Eigen::Vector3d& point) const;

 private:
  std::uint64_t key_;
  double spacing_;
};

/// A wave like cos(πx); std::cos differs between machines.
double smooth_wave(double x);

/// Hashes three numbers with the finaliser of SplitMix64 (Steele, Lea & Flood 2014, "Fast
/// splittable pseudorandom number generators").
std::uint64_t mix(std::uint64_t a, std::uint64_t b, std::uint64_t c);

}  // namespace crowdface::synth
