// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/io/image.h"
#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// The image in linear light. Integers count as sRGB, floats as linear. If the image is grey, its
/// first channel becomes all three colour channels of the result. Alpha is ignored.
/// \param image  must outlive the result.
ImageRows light_of(const Image& image);

/// Converts tangent-space normals, stored in 0 … 1, to two slopes: to the right and upwards in the
/// image.
ImageRows slopes_of(const Image& image);
/// The unconverted values of the first one or three channels.
ImageRows values_of(const Image& image);

}  // namespace crowdface
