// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/sampling_pattern.h"
#include "crowdface/render/screen_quads.h"
#include "crowdface/render/stage.h"

namespace crowdface {

/// Where rays go.
struct Sampling {
  PixelPlaces middle;  ///< the place in every pixel
  PixelPlaces
      coarse;  ///< those where something is worn, which may be there in part, or where relief is
  PixelPlaces fine;          ///< those where the picture changes
  InterleavedDisc key, sky;  ///< rays of a pixel towards each light

  Sampling(int samples_per_side, int key_rays, int sky_rays)
      : middle(places_in_pixel(1)),
        coarse(places_in_pixel(std::min(2, samples_per_side))),
        fine(places_in_pixel(samples_per_side)),
        key(key_rays),
        sky(sky_rays) {}
};

/// Renders one square of an image, whatever else there is of it. What a pixel knows of its lights
/// it shares with those around it that show the same surface: each has tried other directions, and
/// together they leave no grain.
/// \param left, top  the square's upper left corner; what sticks out of the image is left out.
void render_tile(const Stage& stage, const Sampling& sampling, int left, int top, Rgb8Image& image);

}  // namespace crowdface
