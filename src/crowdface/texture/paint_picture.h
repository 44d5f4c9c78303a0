// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/texture/crowd_textures.h"

namespace crowdface {

/// What a picture is computed from for one face, at the vertices that it shows: numbers to begin with, and
/// the factor of what each head has stored. Between vertices all of it runs straight.
struct PictureFields {
  std::size_t channels = 3;
  std::vector<std::size_t> heads;  ///< those that lend anything, ascending
  std::vector<float> values;       ///< #vertices by #channels + #heads
  std::size_t width() const { return channels + heads.size(); }
};

/// Each covered texel is its numbers to begin with plus each head's factor times what the head has stored there. Beyond
/// the gutter all texels have the mean of these.
/// \param coding  what the picture's numbers are, and between which they are kept.
/// \param maps    #heads, of the picture's size.
BlendedPicture paint_picture(const SurfaceTexels& texels, const MapCoding& coding,
                             const std::vector<std::shared_ptr<const TextureMap>>& maps,
                             const PictureFields& fields);

}  // namespace crowdface
