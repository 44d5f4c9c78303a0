// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace crowdface {

/// A convex quadratic program in a few unknowns and up to thousands of bounds: what pose of a part
/// misses what is wanted of it least while it breaks no bound.
///
///   minimise  Σ w/2 (a·x − wanted)² + Σ price·x_i   subject to  a·x ≥ least
///
/// Plain arithmetic in a fixed order, so that the result has the same bits everywhere.
class SmallProgram {
 public:
  static constexpr std::size_t kMost = 9;
  using Vector = std::array<double, kMost>;  ///< those beyond the unknowns are 0

  explicit SmallProgram(std::size_t unknowns) : unknowns_(unknowns) {}

  /// Adds weight/2 (a·x − wanted)². \param weight  positive.
  void want(const Vector& a, double wanted, double weight);
  void want(std::size_t unknown, double wanted, double weight);
  /// Bounds a·x from below.
  void demand(const Vector& a, double least);
  void demand_between(std::size_t unknown, double least, double most);
  /// Makes an unknown a slack of what demands name it: not negative, for a price a unit.
  void add_slack(std::size_t unknown, double price);

  /// The solution, by a dual active set (Goldfarb & Idnani 1983). Every unknown must be wanted with
  /// some weight. Where no x satisfies all bounds: one that satisfies some.
  /// \param tolerance  how far a bound may be missed, measured along its normal
  Vector solve(double tolerance) const;

 private:
  struct Bound {
    Vector a;
    double least;
  };
  std::size_t unknowns_;
  std::array<Vector, kMost> quadratic_ = {};
  Vector linear_ = {};
  std::vector<Bound> bounds_;
};

}  // namespace crowdface
