// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/io/image_codec.h"

namespace crowdface {

/// PNGs, the images that nearly every run has: by libpng, which needs none of the libraries that image_codec()
/// loads. Takes and makes no other format.
const ImageCodec& png_codec();

}  // namespace crowdface
