// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/mask_source.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

/// Refuses values below kMinMaskValue. Replaces other negative values by 0.
void replace_small_negatives(const std::string& file, Image& image) {
  const auto channels = mask_channel_indices(image);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (const int channel : channels) {
        const float value = image.at(x, y, channel);
        if (value >= kMinMaskValue) continue;
        throw InvalidInput(concat(file, ": expected mask values of zero or more, found ",
                                  double{value}, " at column ", x + 1, ", row ", y + 1,
                                  ", channel ", channel + 1));
      }
    }
  }
  if (auto* values = std::get_if<std::vector<float>>(&image.pixels)) {
    for (float& value : *values) {
      if (value >= kMinMaskValue) value = std::max(value, 0.0F);
    }
  }
}

}  // namespace

MaskSource::MaskSource(std::string path) : path_(std::move(path)) {}
MaskSource::MaskSource(std::string name, Image image)
    : path_(std::move(name)), image_(std::move(image)) {}

bool MaskSource::is_tiled() const {
  return !image_ && path_.find(kTileWord) != std::string::npos;
}

std::string MaskSource::tile_path(int tile) const {
  return is_tiled() ? udim_tile_path(path_, tile).string() : path_;
}

Image MaskSource::read(int tile) const {
  const std::string file = tile_path(tile);
  Image image = image_ ? *image_ : read_image(file);
  replace_small_negatives(file, image);
  return image;
}

std::vector<int> mask_channel_indices(const Image& image) {
  std::vector<int> channels;
  for (int c = 0; c < image.channels; ++c) {
    if (c != image.alpha_channel) channels.push_back(c);
  }
  return channels;
}

}  // namespace crowdface
