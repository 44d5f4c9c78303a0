// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "head_models/synth/complexion.h"

namespace crowdface::synth {

/// The texture of hair_picture has kTextureStripCount vertical strips: kCardStripCount strips for
/// hair cards, then one strip for the hair cap below the cards.
inline constexpr int kCardStripCount = 4, kTextureStripCount = 5;
/// The last two strips for hair cards have fewer strands: kThinStrip has half as many as the other
/// strips, kWispStrip has a few single strands.
inline constexpr int kThinStrip = kCardStripCount - 2, kWispStrip = kCardStripCount - 1;

/// sRGB value of hair in neutral textures. Neutral textures are tinted with each face's hair colour
/// (see Tint).
inline constexpr double kNeutralTone = 0.67;

/// Paints a hair texture: vertical strips of strands from roots (v = 1) to separate tips (v = 0).
/// The last strip is opaque except at the tips.
/// \return size × size × 4 bytes (sRGB and alpha), row by row, first row at v = 1.
std::vector<std::uint8_t> hair_picture(int size, const ScreenColour& colour, bool curly);

}  // namespace crowdface::synth
