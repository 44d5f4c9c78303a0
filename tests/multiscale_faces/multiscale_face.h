// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "multiscale_faces/front_patch.h"
#include "multiscale_faces/spline_lattice.h"

namespace crowdface::multiscale {

/// Number of spline spans along each side of the coarsest and of the finest lattice. Level k has
/// kCoarsestSpans·2^k spans.
inline constexpr Index kCoarsestSpans = 4;
inline constexpr Index kFinestSpans = 256;
inline constexpr int kLevelCount = 7;
static_assert(kCoarsestSpans << (kLevelCount - 1) == kFinestSpans);

/// Number of samples along each side of the square on which a face is resampled: two per span of
/// the finest lattice.
inline constexpr Index kSamplesPerSide = 2 * kFinestSpans + 1;

/// A face in the method of Yoon, Lewis and Rhee (2017), as "Laplacian face blending" (Section 2.3)
/// describes it: a smooth base surface and scalar displacements along its normals, one continuous
/// displacement map for each finer level. Our choices where that description is open:
/// - Samples lie on a regular grid of the square. Holes have no samples; the splines close the
///   holes.
/// - A level's displacement is the distance at which the base's normal meets the level's surface.
///   If the normal misses the surface (overhangs: nostrils, behind the wings of the nose), the
///   displacement is the difference of both surfaces at the same (u, v), projected onto the normal.
struct MultiscaleFace {
  TextureCoordinates uvs;               ///< #P by 2, of the patch's vertices
  std::vector<SplineLattice> surfaces;  ///< by level, coarsest first; values are positions
  int base_level = 0;                   ///< the level of the base surface
  /// For each level above base_level: the distance of the level's surface along the normals of the
  /// base surface, minus the distance of the previous level's surface.
  std::vector<SplineLattice> displacements;
  /// fraction of samples at which the line along the normal misses the finest surface
  double missed_sample_fraction = 0;
};

/// Computes the levels of a face.
/// \param positions   #P by 3: one row per vertex of the patch.
/// \param base_level  0 … kLevelCount − 2.
MultiscaleFace multiscale_face(const FrontPatch& patch, const Positions& positions, int base_level);
/// Returns the same face with another base level.
MultiscaleFace with_base_level(MultiscaleFace face, int base_level);

/// One source face, and the weights with which a new face takes its details.
struct WeightedSource {
  const MultiscaleFace* face = nullptr;
  /// For each level from base_level + 1 on, the weight of the level's detail in the whole patch.
  std::vector<double> level_weights;
  /// For each vertex of the patch, a factor on all `level_weights`. If empty, all factors are 1.
  std::vector<double> vertex_weights = {};
};

/// Makes a new face: the base surface of `target`, displaced along the surface's normals by the
/// weighted sum of the displacements of `sources`. All faces in `sources` must have the base level
/// of `target`.
/// \return #P by 3: a position for each vertex of the target's patch.
Positions synthesize(const MultiscaleFace& target, std::span<const WeightedSource> sources);

}  // namespace crowdface::multiscale
