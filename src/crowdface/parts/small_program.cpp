// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/small_program.h"

#include <cmath>
#include <limits>

namespace crowdface {
namespace {

using Vector = SmallProgram::Vector;
using Matrix = std::array<Vector, SmallProgram::kMost>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A bound's normal less than this off those that are active depends on them (squared, of unit length).
constexpr double kDependent = 1e-12;

double dot(const Vector& a, const Vector& b, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// Lower L with L Lᵀ = g.
Matrix cholesky(const Matrix& g, std::size_t n) {
  Matrix l{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double rest = g[i][j] - dot(l[i], l[j], j);
      l[i][j] = i == j ? std::sqrt(rest) : rest / l[j][j];
    }
  }
  return l;
}

/// L⁻¹ b.
Vector forward(const Matrix& l, const Vector& b, std::size_t n) {
  Vector x{};
  for (std::size_t i = 0; i < n; ++i) x[i] = (b[i] - dot(l[i], x, i)) / l[i][i];
  return x;
}

/// L⁻ᵀ b.
Vector backward(const Matrix& l, const Vector& b, std::size_t n) {
  Vector x{};
  for (std::size_t i = n; i-- > 0;) {
    double rest = b[i];
    for (std::size_t j = i + 1; j < n; ++j) rest -= l[j][i] * x[j];
    x[i] = rest / l[i][i];
  }
  return x;
}

/// The bounds that hold with equality, with the force of each.
struct Active {
  std::array<Vector, SmallProgram::kMost> normals = {};
  Vector forces = {};
  std::size_t count = 0;

  /// The shares of the active normals in `a`, least squares.
  Vector shares_in(const Vector& a, std::size_t n) const {
    Matrix gram{};
    Vector right{};
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j <= i; ++j) gram[i][j] = dot(normals[i], normals[j], n);
      right[i] = dot(normals[i], a, n);
    }
    const Matrix l = cholesky(gram, count);
    return backward(l, forward(l, right, count), count);
  }
  void add(const Vector& normal, double force) {
    normals[count] = normal;
    forces[count++] = force;
  }
  void drop(std::size_t which) {
    for (std::size_t i = which; i + 1 < count; ++i) {
      normals[i] = normals[i + 1];
      forces[i] = forces[i + 1];
    }
    --count;
  }
};

/// Moves x onto the bound a·x ≥ least, dropping active bounds that push against it.
/// \return false if it cannot be reached.
bool reach(Active& active, const Vector& a, double least, Vector& x, std::size_t n) {
  double force = 0;
  for (std::size_t guard = 0; guard <= SmallProgram::kMost; ++guard) {
    const Vector shares = active.shares_in(a, n);
    Vector step = a;
    for (std::size_t j = 0; j < active.count; ++j) {
      for (std::size_t i = 0; i < n; ++i) step[i] -= shares[j] * active.normals[j][i];
    }
    double blocked = kInfinity;
    std::size_t blocker = 0;
    for (std::size_t j = 0; j < active.count; ++j) {
      if (shares[j] > 0 && active.forces[j] / shares[j] < blocked) {
        blocked = active.forces[j] / shares[j];
        blocker = j;
      }
    }
    const double square = dot(step, step, n);
    const bool depends = active.count == n || square <= kDependent;
    const double whole = depends ? kInfinity : (least - dot(a, x, n)) / square;
    if (blocked == kInfinity && whole == kInfinity) return false;
    const double length = blocked < whole ? blocked : whole;
    for (std::size_t j = 0; j < active.count; ++j) active.forces[j] -= length * shares[j];
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

}  // namespace

void SmallProgram::want(const Vector& a, double wanted, double weight) {
  for (std::size_t i = 0; i < unknowns_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) quadratic_[i][j] += weight * a[i] * a[j];
    linear_[i] += weight * wanted * a[i];
  }
}

void SmallProgram::want(std::size_t unknown, double wanted, double weight) {
  quadratic_[unknown][unknown] += weight;
  linear_[unknown] += weight * wanted;
}

void SmallProgram::charge(std::size_t unknown, double price) {
  linear_[unknown] -= price;
}

void SmallProgram::demand(const Vector& a, double least) {
  bounds_.push_back({a, least});
}

void SmallProgram::demand(std::size_t unknown, double least) {
  Vector a{};
  a[unknown] = 1;
  demand(a, least);
}

SmallProgram::Vector SmallProgram::solve(double tolerance) const {
  constexpr int kMostSteps = 200;
  const std::size_t n = unknowns_;
  // In y = Lᵀ x the quadratic form is a plain distance, and normals are made of unit length.
  const Matrix l = cholesky(quadratic_, n);
  std::vector<Bound> bounds;
  bounds.reserve(bounds_.size());
  std::vector<double> lengths;
  lengths.reserve(bounds_.size());
  for (const Bound& bound : bounds_) {
    Bound scaled{forward(l, bound.a, n), bound.least};
    const double length = std::sqrt(dot(scaled.a, scaled.a, n));
    if (!(length > 0)) continue;
    for (double& value : scaled.a) value /= length;
    scaled.least /= length;
    bounds.push_back(scaled);
    // What a step of one in x along the normal makes in y.
    lengths.push_back(length / std::sqrt(dot(bound.a, bound.a, n)));
  }
  Vector y = forward(l, linear_, n);
  Active active;
  for (int step = 0; step < kMostSteps; ++step) {
    double worst = tolerance;
    std::size_t which = bounds.size();
    for (std::size_t b = 0; b < bounds.size(); ++b) {
      const double missing = (bounds[b].least - dot(bounds[b].a, y, n)) * lengths[b];
      if (missing <= worst) continue;
      worst = missing;
      which = b;
    }
    if (which == bounds.size()) break;
    if (!reach(active, bounds[which].a, bounds[which].least, y, n)) break;
  }
  return backward(l, y, n);
}

}  // namespace crowdface
