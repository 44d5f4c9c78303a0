// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/render/texture.h"

namespace crowdface {

/// Pictures as addresses that hold them (data:image/…;base64,…): a page opened from disk may load no files
/// into textures. Larger ones are made smaller, to `most_px` texels a side.

/// As JPEG, sRGB.
std::string colour_picture(const Texture& texture, int most_px);
/// The first channel, as PNG of one.
std::string opacity_picture(const Texture& texture, int most_px);

}  // namespace crowdface
