// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_size.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface::multiscale {

Differences differences(const FrontPatch& patch, const Positions& a, const Positions& b) {
  const Positions apart = b - a;
  const SurfaceTree surface(a, patch.triangles);
  const double to_surface = parallel_sum(b.rows(), kRowsPerTask, [&](Index begin, Index end) {
    double sum = 0;
    for (Index v = begin; v < end; ++v) {
      const double distance = surface.nearest(b.row(v).transpose(), HUGE_VAL).distance;
      sum += distance * distance;
    }
    return sum;
  });
  const auto count = static_cast<double>(apart.rows());
  return {std::sqrt(apart.squaredNorm() / count), apart.rowwise().norm().maxCoeff(),
          std::sqrt(to_surface / count)};
}

std::vector<double> band_energies(const Topology& topology, const FrontPatch& patch,
                                  const Positions& positions,
                                  const std::vector<double>& bounds_mm) {
  const Adjacency adjacency = build_adjacency(topology);
  const Components components = find_components(adjacency);
  const double edge = rms_edge_length(adjacency, components, components.largest(), positions);
  std::vector<std::uint64_t> iterations;
  for (const double size : bounds_mm) {
    iterations.push_back(iterations_for_wavelength(OperatorKind::kUmbrella, size, edge));
  }
  const SmoothingOperator smoothing(adjacency, Boundary::kFixed, OperatorKind::kUmbrella);
  const ChebyshevFilter filter(smoothing, positions);
  std::vector<double> energies;
  Positions finer = patch.rows_of(positions);
  for (const Positions& smoothed : smooth(filter, positions, iterations)) {
    Positions coarser = patch.rows_of(smoothed);
    energies.push_back((finer - coarser).squaredNorm());
    finer = std::move(coarser);
  }
  return energies;
}

double largest_rim_distance(const std::vector<std::vector<std::uint32_t>>& rims, const Positions& a,
                            const Positions& b) {
  double largest = 0;
  for (const auto& rim : rims) {
    for (const std::uint32_t v : rim) largest = std::max(largest, (a.row(v) - b.row(v)).norm());
  }
  return largest;
}

namespace {

/// Returns the pairs of adjacent triangles whose common edge lies in the border between regions
/// (both end points of the edge are marked in `border`).
std::vector<std::pair<std::size_t, std::size_t>> triangle_pairs_in(
    const FrontPatch& patch, const std::vector<bool>& border) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> first;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const Triangle& corners = patch.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
      if (!border[a] || !border[b]) continue;
      const auto [other, is_new] = first.emplace(std::minmax(a, b), t);
      if (!is_new) pairs.emplace_back(other->second, t);
    }
  }
  return pairs;
}

}  // namespace

double largest_new_crease(const FrontPatch& patch, const Positions& face,
                          const std::vector<Positions>& heads, const std::vector<bool>& border) {
  double largest = 0;
  for (const auto& [s, t] : triangle_pairs_in(patch, border)) {
    const auto crease = [&, s = s, t = t](const Positions& positions) {
      const Eigen::Vector3d a = area_vector(positions, patch.triangles[s]),
                            b = area_vector(positions, patch.triangles[t]);
      return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
    };
    double known = 0;
    for (const Positions& head : heads) known = std::max(known, crease(head));
    largest = std::max(largest, crease(face) - known);
  }
  return largest;
}

}  // namespace crowdface::multiscale
