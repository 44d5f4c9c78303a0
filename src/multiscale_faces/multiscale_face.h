// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "multiscale_faces/front_patch.h"
#include "multiscale_faces/spline_lattice.h"

namespace crowdface::multiscale {

/// Number of spline spans along each side of the coarsest and of the finest lattice. Level k has
/// kCoarsest·2^k spans.
inline constexpr Index kCoarsest = 4;
inline constexpr Index kFinest = 256;
inline constexpr int kLevels = 7;
static_assert(kCoarsest << (kLevels - 1) == kFinest);

/// Number of samples along each side of the square on which a face is resampled: two per span of
/// the finest lattice.
inline constexpr Index kSamplesPerSide = 2 * kFinest + 1;

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
  int base = 0;                         ///< the level of the base surface
  std::vector<SplineLattice>
      displacements;        ///< by level from base + 1 on: added to the previous level
  double missed_share = 0;  ///< fraction of samples whose normals miss the finest surface
};

/// Computes the levels of a face.
/// \param positions  #P by 3, in the patch's numbers. \param base  0 … kLevels − 2.
MultiscaleFace multiscale_face(const FrontPatch& patch, const Positions& positions, int base);
/// Returns the same face with another base level.
MultiscaleFace with_base(MultiscaleFace face, int base);

/// The details that a new face takes from one source face.
struct Details {
  const MultiscaleFace* face = nullptr;
  /// For each level from base + 1 on, the weight of the level's detail in the whole patch.
  std::vector<double> level_weights;
  /// #P factors on `level_weights`; empty: 1 everywhere.
  std::vector<double> vertex_weights = {};
};

/// Makes a new face: the base surface of `target`, displaced along its normals by the weighted sum
/// of the details of all faces, which have the same base level.
/// \return #P by 3: a position for each vertex of the target's patch.
Positions synthesize(const MultiscaleFace& target, std::span<const Details> details);

}  // namespace crowdface::multiscale
