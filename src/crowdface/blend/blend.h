// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/chebyshev_filter.h"

namespace crowdface {

/// Returns B, #V by 3: the positions of the target or, if the target is a mixture, the weighted
/// mean of the heads in the mixture.
Positions target_positions(const HeadSet& heads, const Recipe& recipe);

/// Blends the face of a recipe, without mirroring. Unlike CrowdBlender, smooths exactly: applies
/// the filter once for each band of each region. If each region has one band, the blended face A is
/// given by Eq. 7, which has two equal forms:
///
///     A = Σ_k α_k [ e_k C̄_k + S_{L_k} D_k ]
///     A = B + Σ_k α_k [ S_{L_k} D_k − D_k ]
///
/// The function computes the second form. Its symbols have these meanings:
///
/// - B is the target; for a mixture, B is the weighted mean of its heads.
/// - α_k are the vertex weights of region k.
/// - S_{L_k} is the smoothing to the level L_k of region k.
/// - e_k is the extrapolation factor of region k.
/// - C̄_k = Σ_i ω̂_ki C_i is the weighted mean of the source heads C_i, with the normalised weights
///   ω̂_ki of region k.
/// - D_k = B − e_k C̄_k.
///
/// weights_by_level generalises Eq. 7 to several bands. The second form keeps a vertex
/// bit-identical to B if the vertex is fixed, or if D_k = 0 at this vertex (because the target is
/// blended with itself).
///
/// \param regions  α of the recipe's regions, #V by #regions; rows sum to one.
/// \return         #V by 3, in the unit of the heads.
/// \throws BrokenPrecondition if recipe, regions and heads do not fit together.
Positions blend_exact(const HeadSet& heads, const ChebyshevFilter& filter,
                      const RegionWeights& regions, const Recipe& recipe);

/// Blends several faces in one pass of the filter. The results have the same bits as if each face
/// were blended alone.
///
/// \param results  receives the positions of the face of each recipe.
void blend_exact(const HeadSet& heads, const ChebyshevFilter& filter, const RegionWeights& regions,
                 std::span<const Recipe* const> recipes, std::span<Positions> results);

}  // namespace crowdface
