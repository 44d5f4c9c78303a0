// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace crowdface {

/// A convex quadratic program in a few unknowns with up to thousands of constraints. Finds the pose
/// of a part that is nearest to a desired pose and violates no constraint.
///
/// minimise Σ w/2 (a·x − target)² + Σ (penalty·x_i + x_i²/2) subject to a·x ≥ lower
///
/// Here, x is the vector of unknowns. Some unknowns x_i are slack variables, which a constraint may
/// contain to become soft; the second sum is over these. Each target and each constraint has its
/// own coefficients a, and each target its own weight w.
///
/// The class uses plain arithmetic in a fixed order, so that the result has the same bits on every
/// machine.
class QuadraticProgram {
 public:
  static constexpr std::size_t kMaxUnknowns = 9;    ///< largest number of unknowns
  using Vector = std::array<double, kMaxUnknowns>;  ///< entries beyond the number of unknowns are 0

  explicit QuadraticProgram(std::size_t unknowns) : unknowns_(unknowns) {}

  /// Adds the term weight/2 (a·x − target)². \param weight  Positive.
  void add_target(const Vector& a, double target, double weight);
  /// Adds the term weight/2 (x_i − target)² for one unknown x_i. \param unknown  the index i.
  void add_target(std::size_t unknown, double target, double weight);
  /// Adds the constraint a·x ≥ lower.
  void add_lower_bound(const Vector& a, double lower);
  /// Adds the constraints lower ≤ x_i ≤ upper for one unknown x_i. \param unknown  the index i.
  void add_bounds(std::size_t unknown, double lower, double upper);
  /// Makes an unknown x_i a slack variable, with the bound x_i ≥ 0 and the cost penalty·x_i +
  /// x_i²/2. A constraint a·x ≥ lower that contains x_i may then be violated by the other unknowns,
  /// by up to x_i times its coefficient in a.
  void add_slack(std::size_t unknown, double penalty);

  /// Returns the solution, by the dual active-set method (Goldfarb & Idnani 1983). Every unknown
  /// must occur in at least one target of positive weight. If no x satisfies all constraints, the
  /// solution satisfies some of them.
  ///
  /// \param tolerance  Largest violation of a constraint, measured along its normal.
  Vector solve(double tolerance) const;

 private:
  /// The constraint a·x ≥ lower.
  struct Bound {
    Vector a;
    double lower;
  };
  std::size_t unknowns_;
  std::array<Vector, kMaxUnknowns> quadratic_ = {};  ///< Q of the objective ½ xᵀ Q x − linear·x
  Vector linear_ = {};         ///< `linear` of the objective ½ xᵀ Q x − linear·x
  std::vector<Bound> bounds_;  ///< all constraints, each a lower bound for a·x
};

}  // namespace crowdface
