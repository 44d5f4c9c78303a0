// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_nodes.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "crowdface/core/fixed_order.h"
#include "crowdface/core/require.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

constexpr std::size_t kMaxNodes = 48;
/// Weight of the smoothing operator's negative eigenvalues in the least-squares fit of the
/// interpolation weights. Negative eigenvalues belong to checkerboard modes. In the shape of a
/// head, the typical amplitude of these modes is this fraction of the amplitude of the smoothest
/// modes.
constexpr double kNegativeWeight = 1e-2;

/// Exponentiation by squaring, because std::pow differs between C libraries.
double power(double base, std::uint64_t exponent) {
  double result = 1;
  for (; exponent > 0; exponent >>= 1, base *= base) {
    if ((exponent & 1) != 0) result *= base;
  }
  return result;
}

/// The levels that may become nodes. If max_level is at most kAll, these are all levels up to
/// max_level. Otherwise, these are all levels up to 64, and a selection of the higher levels. The
/// distance between selected levels grows with the level. The successor of each selected level is
/// also a candidate, so that even and odd levels occur.
std::vector<std::uint64_t> node_candidates(std::uint64_t max_level) {
  constexpr std::uint64_t kAll = 1024;
  constexpr int kSteps = 768;
  std::vector<std::uint64_t> candidates;
  for (std::uint64_t level = 1; level <= std::min<std::uint64_t>(max_level, 64); ++level) {
    candidates.push_back(level);
  }
  if (max_level <= kAll) {
    for (std::uint64_t level = 65; level <= max_level; ++level) candidates.push_back(level);
    return candidates;
  }
  for (const std::uint64_t level : levels_dense_at_start(max_level, kSteps)) {
    if (level == 0) continue;
    candidates.push_back(level);
    if (level < max_level) candidates.push_back(level + 1);
  }
  std::ranges::sort(candidates);
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return candidates;
}

}  // namespace

LevelNodes::LevelNodes(OperatorKind kind, std::uint64_t max_level, double max_residual)
    : max_level_(max_level) {
  require(max_level > 0, "nodes of levels need a largest level of at least 1");
  // Build a grid of eigenvalues λ of the smoothing operator. On this grid, s = 1 − |λ| falls
  // geometrically from 1, until s is too small to matter at any level up to max_level. The weight
  // of a grid point is the typical amplitude of the modes with this eigenvalue in the shape of a
  // head. This amplitude grows with the mode's wavelength, which is proportional to 1/√s.
  constexpr double kRatio = 1.1;
  const double least = 0.3 / static_cast<double>(max_level);
  for (double s = 1; s > least; s /= kRatio) {
    eigenvalues_.push_back(1 - s);
    grid_weights_.push_back(std::sqrt(least / s));
    if (kind == OperatorKind::kLazy) continue;
    eigenvalues_.push_back(s - 1);
    grid_weights_.push_back(kNegativeWeight);
  }
  if (kind == OperatorKind::kUmbrella) {
    eigenvalues_.push_back(-1);
    grid_weights_.push_back(kNegativeWeight);
  }
  choose_nodes(node_candidates(max_level), max_residual);
}

LevelNodes::Spectrum LevelNodes::displacement(std::uint64_t level) const {
  Spectrum values(eigenvalues_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = grid_weights_[i] * (power(eigenvalues_[i], level) - 1);  // λ^L − 1
  }
  return values;
}

void LevelNodes::choose_nodes(const std::vector<std::uint64_t>& candidates, double max_residual) {
  // For each candidate, the residual after subtracting the projection onto the nodes chosen so far.
  std::vector<Spectrum> residuals;
  residuals.reserve(candidates.size());
  for (const std::uint64_t level : candidates) residuals.push_back(displacement(level));
  const double enough =
      max_residual * max_residual * fixed_order_dot(residuals.back(), residuals.back());
  std::vector<std::uint64_t> chosen;
  while (chosen.size() < std::min(kMaxNodes, candidates.size())) {
    // The next node is the candidate with the largest residual.
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const double length = fixed_order_dot(residuals[i], residuals[i]);
      if (length > most) most = length, worst = i;
    }
    if (most <= enough) break;
    // Subtract from each residual its component along the new direction, which belongs to the
    // chosen node.
    Spectrum direction = residuals[worst];
    orthonormalize(
        direction, orthonormal_basis_.size(),
        [&](std::size_t m) { return std::span(orthonormal_basis_[m]); },
        [](std::size_t, double) {});
    for (Spectrum& spectrum : residuals)
      subtract_scaled(fixed_order_dot(spectrum, direction), direction, spectrum);
    chosen.push_back(candidates[worst]);
    orthonormal_basis_.push_back(std::move(direction));
  }
  levels_ = chosen;
  std::ranges::sort(levels_);
  for (const std::uint64_t level : chosen) {
    choice_order_.push_back(
        static_cast<std::size_t>(std::ranges::lower_bound(levels_, level) - levels_.begin()));
    const Spectrum node = displacement(level);
    std::vector<double> row;
    for (std::size_t q = 0; q <= triangular_factor_.size(); ++q)
      row.push_back(fixed_order_dot(node, orthonormal_basis_[q]));
    triangular_factor_.push_back(std::move(row));
  }
}

std::vector<double> LevelNodes::interpolation_weights(std::uint64_t level) const {
  require(level <= max_level_, "level ", level, " is above the largest, ", max_level_);
  std::vector<double> result(levels_.size(), 0.0);
  if (level == 0) return result;
  if (const auto node = std::ranges::lower_bound(levels_, level);
      node != levels_.end() && *node == level) {
    result[static_cast<std::size_t>(node - levels_.begin())] = 1;
    return result;
  }
  // Find the weights of the nodes by least squares over the grid of eigenvalues: project the
  // displacement at this level onto the orthonormal basis of the nodes' displacements. Then solve
  // the triangular system for the weights of the nodes.
  const Spectrum level_displacement = displacement(level);
  std::vector<double> share;
  share.reserve(orthonormal_basis_.size());
  for (const Spectrum& direction : orthonormal_basis_)
    share.push_back(fixed_order_dot(level_displacement, direction));
  for (std::size_t p = choice_order_.size(); p-- > 0;) {
    const double weight = share[p] / triangular_factor_[p][p];
    for (std::size_t q = 0; q < p; ++q) share[q] -= weight * triangular_factor_[p][q];
    result[choice_order_[p]] = weight;
  }
  return result;
}

}  // namespace crowdface
