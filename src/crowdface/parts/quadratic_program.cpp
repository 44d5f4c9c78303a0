// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/quadratic_program.h"

#include <cmath>
#include <limits>

#include "crowdface/core/fixed_order.h"

namespace crowdface {
namespace {

using Vector = QuadraticProgram::Vector;
using Matrix = std::array<Vector, QuadraticProgram::kMaxUnknowns>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A unit normal of a constraint counts as dependent on the active normals if its squared distance
/// from their span is below this value.
constexpr double kDependent = 1e-12;

double dot(const Vector& a, const Vector& b, std::size_t n) {
  return fixed_order_dot({a.data(), n}, {b.data(), n});
}

/// Returns L⁻ᵀ b.
Vector backward(const Matrix& l, const Vector& b, std::size_t n) {
  Vector x{};
  for (std::size_t i = n; i-- > 0;) {
    double rest = b[i];
    for (std::size_t j = i + 1; j < n; ++j) rest -= l[j][i] * x[j];
    x[i] = rest / l[i][i];
  }
  return x;
}

/// The active constraints, which hold with equality, and the multiplier of each.
struct Active {
  std::array<Vector, QuadraticProgram::kMaxUnknowns> normals = {};
  Vector multipliers = {};
  std::size_t count = 0;

  /// Returns the coefficients of the combination of active normals that is nearest to `a` in the
  /// least-squares sense.
  Vector shares_in(const Vector& a, std::size_t n) const {
    Matrix gram{};
    Vector right{};
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j <= i; ++j) gram[i][j] = dot(normals[i], normals[j], n);
      right[i] = dot(normals[i], a, n);
    }
    const Matrix l = cholesky(gram, count);
    return backward(l, solve_lower(l, right, count), count);
  }
  void add(const Vector& normal, double force) {
    normals[count] = normal;
    multipliers[count++] = force;
  }
  void drop(std::size_t which) {
    for (std::size_t i = which; i + 1 < count; ++i) {
      normals[i] = normals[i + 1];
      multipliers[i] = multipliers[i + 1];
    }
    --count;
  }
};

/// Moves x until the constraint holds with equality, a·x = lower. Drops active constraints whose
/// multipliers would become negative.
///
/// \return  false if x cannot reach the constraint.
bool move_onto(Active& active, const Vector& a, double lower, Vector& x, std::size_t n) {
  double force = 0;
  for (std::size_t guard = 0; guard <= QuadraticProgram::kMaxUnknowns; ++guard) {
    const Vector shares = active.shares_in(a, n);
    Vector step = a;
    for (std::size_t j = 0; j < active.count; ++j) {
      for (std::size_t i = 0; i < n; ++i) step[i] -= shares[j] * active.normals[j][i];
    }
    double blocked = kInfinity;
    std::size_t blocker = 0;
    for (std::size_t j = 0; j < active.count; ++j) {
      if (shares[j] > 0 && active.multipliers[j] / shares[j] < blocked) {
        blocked = active.multipliers[j] / shares[j];
        blocker = j;
      }
    }
    const double square = dot(step, step, n);
    const bool depends = active.count == n || square <= kDependent;
    const double whole = depends ? kInfinity : (lower - dot(a, x, n)) / square;
    if (blocked == kInfinity && whole == kInfinity) return false;
    const double length = blocked < whole ? blocked : whole;
    if (!std::isfinite(length)) return false;  // positions are not finite
    for (std::size_t j = 0; j < active.count; ++j) active.multipliers[j] -= length * shares[j];
    force += length;
    if (!depends) {
      for (std::size_t i = 0; i < n; ++i) x[i] += length * step[i];
    }
    if (whole <= blocked) {
      active.add(a, force);
      return true;
    }
    active.drop(blocker);
  }
  return false;
}

/// All constraints, as conditions on y = Lᵀ x, where L is the Cholesky factor of the quadratic
/// form. They are stored by column, so that loops over constraints vectorise.
template <class Bound>
class Table {
 public:
  Table(const std::vector<Bound>& bounds, const Matrix& l, std::size_t n)
      : unknowns_(n),
        count_(bounds.size()),
        normals_(n * count_),
        lower_(count_),
        stretch_(count_) {
    std::vector<double> before(count_, 0.0), after(count_, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      double* column = normals_.data() + i * count_;
      for (std::size_t b = 0; b < count_; ++b) {
        column[b] = bounds[b].a[i];
        before[b] += column[b] * column[b];
      }
      for (std::size_t j = 0; j < i; ++j) {  // L⁻¹ a
        const double* solved = normals_.data() + j * count_;
        for (std::size_t b = 0; b < count_; ++b) column[b] -= l[i][j] * solved[b];
      }
      for (std::size_t b = 0; b < count_; ++b) {
        column[b] /= l[i][i];
        after[b] += column[b] * column[b];
      }
    }
    for (std::size_t b = 0; b < count_; ++b) {
      const double length = after[b] > 0 ? std::sqrt(after[b]) : 1;
      stretch_[b] = before[b] > 0 ? length / std::sqrt(before[b]) : 0;
      lower_[b] = bounds[b].lower / length;
      for (std::size_t i = 0; i < n; ++i) normals_[i * count_ + b] /= length;
    }
  }

  /// Computes the violation of each constraint a·x ≥ lower by the unknowns x that belong to y: the
  /// signed distance of x from the constraint's plane a·x = lower; negative if x fulfils the
  /// constraint.
  void compute_violations(const Vector& y, std::vector<double>& result) const {
    result = lower_;
    for (std::size_t i = 0; i < unknowns_; ++i) {
      const double* column = normals_.data() + i * count_;
      for (std::size_t b = 0; b < count_; ++b) result[b] -= column[b] * y[i];
    }
    for (std::size_t b = 0; b < count_; ++b) result[b] *= stretch_[b];
  }
  Vector normal(std::size_t bound) const {
    Vector result{};
    for (std::size_t i = 0; i < unknowns_; ++i) result[i] = normals_[i * count_ + bound];
    return result;
  }
  double lower(std::size_t bound) const { return lower_[bound]; }

 private:
  std::size_t unknowns_, count_;
  std::vector<double> normals_;  ///< unit normals of the constraints, #unknowns by #constraints
  std::vector<double> lower_, stretch_;
};

}  // namespace

void QuadraticProgram::add_target(const Vector& a, double target, double weight) {
  for (std::size_t i = 0; i < unknowns_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) quadratic_[i][j] += weight * a[i] * a[j];
    linear_[i] += weight * target * a[i];
  }
}

void QuadraticProgram::add_target(std::size_t unknown, double target, double weight) {
  quadratic_[unknown][unknown] += weight;
  linear_[unknown] += weight * target;
}

void QuadraticProgram::add_lower_bound(const Vector& a, double lower) {
  bounds_.push_back({a, lower});
}

void QuadraticProgram::add_bounds(std::size_t unknown, double lower, double upper) {
  Vector a{};
  a[unknown] = 1;
  add_lower_bound(a, lower);
  a[unknown] = -1;
  add_lower_bound(a, -upper);
}

void QuadraticProgram::add_slack(std::size_t unknown, double penalty) {
  add_target(unknown, 0, 1);
  linear_[unknown] -= penalty;
  Vector a{};
  a[unknown] = 1;
  add_lower_bound(a, 0);
}

QuadraticProgram::Vector QuadraticProgram::solve(double tolerance) const {
  constexpr int kMaxSteps = 200;
  const std::size_t n = unknowns_;
  // In the coordinates y = Lᵀ x, with the Cholesky factor L, the objective is a squared Euclidean
  // distance. Constraint normals are normalised.
  const Matrix l = cholesky(quadratic_, n);
  const Table table(bounds_, l, n);
  Vector y = solve_lower(l, linear_, n);
  std::vector<double> violations(bounds_.size());
  Active active;
  for (int step = 0; step < kMaxSteps; ++step) {
    table.compute_violations(y, violations);
    double worst = tolerance;
    std::size_t which = violations.size();
    // Pick the most violated constraint.
    for (std::size_t b = 0; b < violations.size(); ++b) {
      if (violations[b] <= worst) continue;
      worst = violations[b];
      which = b;
    }
    if (which == violations.size()) break;
    if (!move_onto(active, table.normal(which), table.lower(which), y, n)) break;
  }
  return backward(l, y, n);
}

}  // namespace crowdface
