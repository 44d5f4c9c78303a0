// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/coloured_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface {
namespace {

/// The values of an image as bytes: 0 … 1 becomes 0 … 255.
std::vector<std::uint8_t> eight_bit_values_of(const Image& image) {
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.pixels)) return *bytes;
  std::vector<std::uint8_t> values;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < image.channels; ++c) {
        values.push_back(static_cast<std::uint8_t>(
            std::lround(255 * std::clamp(image.at(x, y, c), 0.0F, 1.0F))));
      }
    }
  }
  return values;
}

}  // namespace

std::vector<AttachmentFile> files_of(const ColouredAttachment& look) {
  std::set<std::filesystem::path> colours;
  if (look.colour) {
    for (const SurfaceMaterial& material : look.item->materials.surface_materials) {
      colours.insert(material.colour_map);
    }
  }
  std::vector<AttachmentFile> files;
  for (const MaterialFile& file : look.item->materials.files) {
    files.push_back({file, colours.contains(file.source)});
  }
  return files;
}

std::string coloured_texture(const std::filesystem::path& neutral, const HairColour& colour) {
  const Image image = read_image(neutral, {.allows_jpeg = true});
  const std::array<float, 3> factors = tint_factors(colour);
  // For each channel, a table: the sRGB value in the neutral texture is the index, the sRGB value
  // after colouring is the entry.
  std::array<std::array<std::uint8_t, 256>, 3> dyed{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < 256; ++v) {
      const float light = light_of_density(static_cast<float>(density_by_srgb8()[v]));
      dyed[c][v] = srgb8_by_density()[density_of_light(factors[c] * light)];
    }
  }
  const std::vector<std::uint8_t> values = eight_bit_values_of(image);
  const bool is_grey = image.channels < 3, has_alpha = image.alpha_channel >= 0;
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(values.size() / channels * 4);
  for (std::size_t i = 0; i < values.size(); i += channels) {
    for (std::size_t c = 0; c < 3; ++c) pixels.push_back(dyed[c][values[i + (is_grey ? 0 : c)]]);
    if (has_alpha) pixels.push_back(values[i + static_cast<std::size_t>(image.alpha_channel)]);
  }
  return encode_png(image.width, image.height, has_alpha ? 4 : 3, pixels);
}

}  // namespace crowdface
