// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/io/image.h"
#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// The image in linear light: integers are taken for sRGB, floats as they are; of grey ones all channels
/// are the first, and alpha counts for nothing.
/// \param image  must outlive the result.
LightRows light_of(const Image& image);

}  // namespace crowdface
