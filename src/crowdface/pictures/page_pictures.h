// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "crowdface/render/texture.h"

namespace crowdface {

/// Converts light in [0, 1] to an sRGB byte; uses a lookup table, because a texture has a million
/// texels.
std::uint8_t srgb_byte(float light);

/// Encodes the slopes of a surface in the texture's two directions as a texel (three bytes) of a
/// tangent-space normal map with y upwards.
std::array<std::uint8_t, 3> normal_texel(const LinearRgb& slopes);

/// The functions below encode images as data URLs (data:image/…;base64,…), because a page opened
/// from disk may not load textures from files. They reduce larger images so that the longer side
/// has `max_px` texels.

/// The texture as JPEG in sRGB.
std::string colour_picture(const Texture& texture, int max_px);
/// A texture of slopes as JPEG: a tangent-space normal map with y upwards.
std::string normal_picture(const Texture& slopes, int max_px);
/// The first channel of the texture as a PNG with one channel.
std::string opacity_picture(const Texture& texture, int max_px);

}  // namespace crowdface
