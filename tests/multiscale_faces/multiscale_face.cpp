// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/multiscale_face.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

#include "multiscale_faces/harmonic_map.h"

namespace crowdface::multiscale {
namespace {

/// Samples of a surface on a regular grid of the unit square. Grid points that no triangle covers
/// have no sample.
struct Samples {
  TextureCoordinates uvs;  ///< #S by 2
  Columns points;          ///< #S by 3
};

/// Resamples a mesh that is parameterized over the unit square.
Samples resample(const std::vector<Triangle>& triangles, const TextureCoordinates& uvs,
                 const Positions& positions) {
  const Index side = kSamplesPerSide;
  const auto step = 1 / static_cast<double>(side - 1);
  Columns points(side * side, 3);
  std::vector<bool> covered(static_cast<std::size_t>(side * side), false);
  for (const Triangle& t : triangles) {
    Eigen::Matrix2d edges;
    edges << (uvs.row(t[1]) - uvs.row(t[0])).transpose(),
        (uvs.row(t[2]) - uvs.row(t[0])).transpose();
    if (!(std::abs(edges.determinant()) > 0)) continue;
    const Eigen::Matrix2d to_barycentric = edges.inverse();
    const Eigen::Array2d low = uvs.row(t[0]).cwiseMin(uvs.row(t[1])).cwiseMin(uvs.row(t[2])) / step;
    const Eigen::Array2d high =
        uvs.row(t[0]).cwiseMax(uvs.row(t[1])).cwiseMax(uvs.row(t[2])) / step;
    for (auto y = static_cast<Index>(std::ceil(low[1])); y <= static_cast<Index>(high[1]); ++y) {
      for (auto x = static_cast<Index>(std::ceil(low[0])); x <= static_cast<Index>(high[0]); ++x) {
        const Eigen::Vector2d at(static_cast<double>(x) * step, static_cast<double>(y) * step);
        const Eigen::Vector2d b = to_barycentric * (at - uvs.row(t[0]).transpose());
        if (b.minCoeff() < -1e-9 || b.sum() > 1 + 1e-9) continue;
        const Index row = x + y * side;
        points.row(row) = (1 - b.sum()) * positions.row(t[0]) + b[0] * positions.row(t[1]) +
                          b[1] * positions.row(t[2]);
        covered[static_cast<std::size_t>(row)] = true;
      }
    }
  }
  const Index count = std::ranges::count(covered, true);
  Samples samples{TextureCoordinates(count, 2), Columns(count, 3)};
  Index next = 0;
  for (Index row = 0; row < side * side; ++row) {
    if (!covered[static_cast<std::size_t>(row)]) continue;
    const Index x = row % side, y = row / side;
    samples.uvs.row(next) << static_cast<double>(x) * step, static_cast<double>(y) * step;
    samples.points.row(next++) = points.row(row);
  }
  return samples;
}

/// A point of a surface and its unit normal.
struct SurfacePoint {
  Eigen::Vector3d point, normal;
};
SurfacePoint surface_point(const SplineLattice& surface, const Eigen::RowVector2d& uv) {
  const Eigen::Matrix3d value_and_derivatives = surface.value_and_derivatives(uv);
  const Eigen::Vector3d normal =
      value_and_derivatives.row(1).cross(value_and_derivatives.row(2)).transpose();
  return {value_and_derivatives.row(0).transpose(), normal.normalized()};
}

/// Moves (u, v) by Newton's method to the point where a normal meets a surface. \return the
/// distance along the normal. If the method does not converge, returns nothing and leaves (u, v)
/// unchanged.
std::optional<double> distance_along(const SurfacePoint& from, const SplineLattice& surface,
                                     Eigen::Ref<Eigen::RowVector2d> start) {
  constexpr int kMaxSteps = 20;
  constexpr double kMaxStep = 0.02;  // of the square's side
  Eigen::RowVector2d uv = start;
  Eigen::Matrix<double, 2, 3> across;  // two directions across the normal
  across.row(0) = from.normal.unitOrthogonal().transpose();
  across.row(1) = from.normal.cross(from.normal.unitOrthogonal()).transpose();
  for (int i = 0; i < kMaxSteps; ++i) {
    const Eigen::Matrix3d value_and_derivatives = surface.value_and_derivatives(uv);
    const Eigen::Vector3d offset = value_and_derivatives.row(0).transpose() - from.point;
    const Eigen::Vector2d residual = across * offset;
    const Eigen::Matrix2d slope = across * value_and_derivatives.bottomRows<2>().transpose();
    if (residual.norm() < 1e-6 * value_and_derivatives.row(1).norm()) {
      start = uv;
      return from.normal.dot(offset);
    }
    if (!(std::abs(slope.determinant()) > 1e-12 * slope.squaredNorm())) return std::nullopt;
    Eigen::Vector2d step = slope.inverse() * residual;
    if (step.norm() > kMaxStep) step *= kMaxStep / step.norm();
    uv = (uv - step.transpose()).cwiseMax(0).cwiseMin(1);
  }
  return std::nullopt;
}

/// Computes the displacement maps of a face whose surfaces and base are set.
void add_displacements(MultiscaleFace& face) {
  const Index side = kSamplesPerSide;
  TextureCoordinates grid(side * side, 2);
  for (Index row = 0; row < grid.rows(); ++row) {
    const Index x = row % side, y = row / side;
    grid.row(row) << static_cast<double>(x), static_cast<double>(y);
  }
  grid /= static_cast<double>(side - 1);

  face.displacements.clear();
  const SplineLattice& base = face.surfaces[static_cast<std::size_t>(face.base_level)];
  Columns before = Columns::Zero(grid.rows(), 1);
  // For each sample: the (u, v) at which the sample's normal meets the surface of the previous
  // level. The search on the surface of the current level starts at this (u, v).
  TextureCoordinates hit_uvs = grid;
  std::vector<char> missed(static_cast<std::size_t>(grid.rows()));
  for (std::size_t level = static_cast<std::size_t>(face.base_level) + 1;
       level < face.surfaces.size(); ++level) {
    const SplineLattice& surface = face.surfaces[level];
    Columns distances(grid.rows(), 1);
    parallel_for_each(grid.rows(), kRowsPerTask, [&](Index s) {
      const SurfacePoint from = surface_point(base, grid.row(s));
      const std::optional<double> distance = distance_along(from, surface, hit_uvs.row(s));
      missed[static_cast<std::size_t>(s)] = distance ? 0 : 1;
      distances(s, 0) = distance
                            ? *distance
                            : from.normal.dot(surface.value(grid.row(s)).transpose() - from.point);
    });
    face.displacements.push_back(
        approximate_by_levels(kCoarsestSpans, surface.spans(), grid, distances - before).back());
    before = std::move(distances);
  }
  face.missed_sample_fraction =
      static_cast<double>(std::ranges::count(missed, 1)) / static_cast<double>(missed.size());
}

}  // namespace

MultiscaleFace multiscale_face(const FrontPatch& patch, const Positions& positions,
                               int base_level) {
  MultiscaleFace face;
  face.uvs = harmonic_map(patch, positions);
  const Samples samples = resample(patch.triangles, face.uvs, positions);
  face.surfaces = approximate_by_levels(kCoarsestSpans, kFinestSpans, samples.uvs, samples.points);
  return with_base_level(std::move(face), base_level);
}

MultiscaleFace with_base_level(MultiscaleFace face, int base_level) {
  require(base_level >= 0 && base_level + 1 < static_cast<int>(face.surfaces.size()),
          "no such base level");
  face.base_level = base_level;
  add_displacements(face);
  return face;
}

Positions synthesize(const MultiscaleFace& target, std::span<const WeightedSource> sources) {
  const SplineLattice& base = target.surfaces[static_cast<std::size_t>(target.base_level)];
  for (const WeightedSource& of : sources) {
    require(of.face->base_level == target.base_level &&
                of.level_weights.size() == of.face->displacements.size(),
            "details need the target's base level and a weight for each level");
  }
  Positions result(target.uvs.rows(), 3);
  parallel_for_each(target.uvs.rows(), kRowsPerTask, [&](Index v) {
    const SurfacePoint at = surface_point(base, target.uvs.row(v));
    double height = 0;
    for (const WeightedSource& of : sources) {
      const double weight =
          of.vertex_weights.empty() ? 1 : of.vertex_weights[static_cast<std::size_t>(v)];
      if (weight == 0) continue;
      for (std::size_t level = 0; level < of.level_weights.size(); ++level) {
        if (of.level_weights[level] == 0) continue;
        height += weight * of.level_weights[level] *
                  of.face->displacements[level].value(target.uvs.row(v))[0];
      }
    }
    result.row(v) = (at.point + height * at.normal).transpose();
  });
  return result;
}

}  // namespace crowdface::multiscale
