// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/io/image_codec.h"

namespace crowdface {

/// The codec for PNG, the format that nearly every run uses. It uses libpng and does not need the
/// libraries that `image_codec` loads.
const ImageCodec& png_codec();

}  // namespace crowdface
