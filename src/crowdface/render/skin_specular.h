// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/render/texture.h"

namespace crowdface {

/// Brightness of a face's skin, estimated from its texture: takes the mean of the channels in each
/// texel, and returns the 70th percentile over all texels.
float skin_lightness(const Texture& texture);

/// Factor on the specular reflection of skin with colour `albedo`, at most 1. Small for texels much
/// darker than the skin: these are painted hair, which has almost no highlight.
/// \param skin_lightness  from skin_lightness(); 0 means unknown and gives a factor of 1.
float skin_specular_factor(const LinearRgb& albedo, float skin_lightness);

}  // namespace crowdface
