// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/io/image.h"
#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// The image in linear light: integers are taken for sRGB, floats as they are; of grey ones all channels
/// are the first, and alpha counts for nothing.
/// \param image  must outlive the result.
LightRows light_of(const Image& image);

/// Tangent-space normals as files have them, 0 … 1, as slopes to the right and upwards.
LightRows slopes_of(const Image& image);
/// The numbers of the first one or three channels, as they are.
LightRows values_of(const Image& image);

}  // namespace crowdface
