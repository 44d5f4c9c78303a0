// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/draw_recipe.h"

namespace crowdface {

/// Returns (1 − t)·a + t·b.
double mixed(double a, double b, double t);
/// Returns (1 − t)·a + t·b for all values of the two bands.
BandRecipe mixed(const BandRecipe& a, const BandRecipe& b, double t,
                 const SmoothingLevelScale& scale);
/// Returns (1 − t)·from + t·to for targets, asymmetry and all bands. Mirroring is taken from
/// `from`, everything else from `to`.
Recipe mixed(const Recipe& from, const Recipe& to, double t, const SmoothingLevelScale& scale);

}  // namespace crowdface
