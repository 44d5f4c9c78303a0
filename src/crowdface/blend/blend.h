// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/chebyshev_filter.h"

namespace crowdface {

/// B, the target's positions or the mixture's, #V by 3.
Positions target_positions(const FaceSet& faces, const Recipe& recipe);

/// The face a recipe stands for, before it is mirrored, with exact levels (Eq. 7, in the form below; of several bands in that
/// of level_shares): one filter application per band and region. With C̄_k = Σ_i ω̂_ki C_i and D_k = B − e_k C̄_k,
///
///     A = Σ_k α_k [ e_k C̄_k + S_{L_k} D_k ] = B + Σ_k α_k [ S_{L_k} D_k − D_k ]
///
/// so that a vertex that no iteration moves (a fixed rim) keeps the target's position to the bit, that
/// of a mixture being the mean of its heads', and so does
/// every vertex where D_k = 0 (the target blended with itself).
/// \param regions  α, #V by #regions, rows summing to one; as many regions as the recipe has.
/// \return         #V by 3, in the heads' unit.
/// \throws BrokenPrecondition if recipe, regions and face set do not fit together.
Positions blend_exact(const FaceSet& faces, const ChebyshevFilter& filter,
                      const RegionWeights& regions, const Recipe& recipe);

/// Several faces in one pass of the filter over the mesh; the same bits as one by one.
/// \param results  one for each recipe.
void blend_exact(const FaceSet& faces, const ChebyshevFilter& filter, const RegionWeights& regions,
                 std::span<const Recipe* const> recipes, std::span<Positions> results);

}  // namespace crowdface
