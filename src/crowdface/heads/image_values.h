// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/io/image.h"
#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// The image's colours as linear light. Integers count as sRGB, floats as linear. All three
/// channels of a grey image get its first channel. Alpha is ignored.
/// \param image  must outlive the result.
ImageRows linear_light_of(const Image& image);

/// Converts an image of tangent-space normals, stored in 0 … 1, to surface slopes: for each texel,
/// the slope to the right and the slope upwards in the image.
ImageRows normal_slopes_of(const Image& image);
/// The image's values without conversion: the first three channels. If the image has fewer than
/// three channels, all three values of a texel are the first channel.
ImageRows channel_values_of(const Image& image);

}  // namespace crowdface
