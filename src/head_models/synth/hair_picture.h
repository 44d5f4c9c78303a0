// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "head_models/synth/complexion.h"

namespace crowdface::synth {

/// Strips that stand side by side in hair_picture: those of cards, then one for what lies below them.
inline constexpr int kCardStrips = 4, kHairStrips = 5;

/// Strands side by side in strips, from roots (v = 1) to tips that stand apart; the last strip is closed but at its tips.
/// size × size × 4 bytes (sRGB and alpha), row by row, first row at v = 1.
std::vector<std::uint8_t> hair_picture(int size, const ScreenColour& colour, bool curly);

}  // namespace crowdface::synth
