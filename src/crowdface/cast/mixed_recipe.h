// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/draw_recipe.h"

namespace crowdface {

/// Mixes the two weights of each head: returns (1 − t)·a + t·b.
std::vector<SourceWeight> mixed_weights(const std::vector<SourceWeight>& a,
                                        const std::vector<SourceWeight>& b, double t);
/// Returns (1 − t)·a + t·b.
double mixed(double a, double b, double t);
/// Returns (1 − t)·a + t·b for the weights, the smoothness and the extrapolation of two bands. The
/// result has no position on the weight plane.
BandRecipe mixed(const BandRecipe& a, const BandRecipe& b, double t,
                 const SmoothingLevelScale& scale);
/// Mixes two recipes: returns (1 − t)·from + t·to for the targets, the asymmetry and all bands. The
/// result is mirrored like `from`; all other values come from `to`.
Recipe mixed(const Recipe& from, const Recipe& to, double t, const SmoothingLevelScale& scale);

}  // namespace crowdface
