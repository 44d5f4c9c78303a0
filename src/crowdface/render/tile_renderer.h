// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "crowdface/render/head_scene.h"
#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/sampling_pattern.h"
#include "crowdface/render/screen_quads.h"

namespace crowdface {

/// The positions of the samples within a pixel, and the directions of the rays towards the lights.
struct Sampling {
  /// one sample in the centre of the pixel
  PixelSamples centre_sample;
  /// Samples for two kinds of pixels without edges: pixels that may show attachments, and pixels
  /// whose normals differ from the normals of the neighbouring pixels.
  PixelSamples coarse_samples;
  PixelSamples fine_samples;  ///< samples for pixels that contain edges of surfaces or colours
  /// directions of each pixel's shadow rays, towards the key light and towards the sky
  InterleavedDisc key_light_directions, sky_directions;

  Sampling(int samples_per_side, int key_light_rays, int sky_rays)
      : centre_sample(sample_positions_in_pixel(1)),
        coarse_samples(sample_positions_in_pixel(std::min(2, samples_per_side))),
        fine_samples(sample_positions_in_pixel(samples_per_side)),
        key_light_directions(key_light_rays),
        sky_directions(sky_rays) {}
};

/// Renders one square of an image, independently of the other squares. Each pixel traces a few
/// shadow rays; neighbouring pixels use different directions. The results of the rays are averaged
/// over neighbouring pixels that show the same surface, which reduces noise.
/// \param left, top  upper left corner of the square; parts outside the image are skipped.
void render_tile(const HeadScene& scene, const Sampling& sampling, int left, int top,
                 Rgb8Image& image);

}  // namespace crowdface
