// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/light_of_image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/render/shading.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface {
namespace {

const std::vector<float>& light_of_srgb16() {
  static const std::vector<float> table = [] {
    std::vector<float> linear(65536);
    for (std::size_t i = 0; i < linear.size(); ++i) {
      linear[i] = from_srgb(Eigen::Array3f::Constant(static_cast<float>(i) / 65535.0F))[0];
    }
    return linear;
  }();
  return table;
}

/// The optical density of each 16-bit sRGB value.
const std::vector<Density>& densities_of_srgb16() {
  static const std::vector<Density> table = [] {
    std::vector<Density> densities;
    for (const float light : light_of_srgb16()) densities.push_back(density_of_light(light));
    return densities;
  }();
  return table;
}

/// Converts a row of integer texels to densities.
/// \param steps  factor that scales a texel's integer to 16 bits
template <class Number>
void write_densities(const Image& image, const std::vector<Number>& numbers, std::size_t steps,
                     int y, const std::array<Density*, 3>& planes) {
  const std::vector<Density>& table = densities_of_srgb16();
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto width = static_cast<std::size_t>(image.width);
  const Number* row = numbers.data() + static_cast<std::size_t>(y) * width * channels;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const Number* at = row + (channels < 3 ? 0 : c);
    for (std::size_t x = 0; x < width; ++x, at += channels) planes[c][x] = table[steps * *at];
  }
}

}  // namespace

ImageRows linear_light_of(const Image& image) {
  const auto row = [&image, &table = light_of_srgb16()](int y, std::span<Eigen::Array3f> texels) {
    const bool grey = image.channels < 3;
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, grey ? 0 : c);
        texels[static_cast<std::size_t>(x)][c] =
            image.has_floats() ? std::max(value, 0.0F)
                               : table[static_cast<std::size_t>(std::lround(65535.0F * value))];
      }
    }
  };
  ImageRows light = {image.width, image.height, row};
  if (!image.has_floats()) {
    light.read_densities = [&image](int y, const std::array<Density*, 3>& planes) {
      if (const auto* bytes = std::get_if<1>(&image.pixels)) {
        write_densities(image, *bytes, 257, y, planes);
      } else {
        write_densities(image, std::get<2>(image.pixels), 1, y, planes);
      }
    };
  }
  return light;
}

ImageRows normal_slopes_of(const Image& image) {
  const auto row = [&image](int y, std::span<Eigen::Array3f> texels) {
    constexpr float kMinUp = 1.0F / 8;  // steepest slope that MapCoding::slope_coding() can store
    for (int x = 0; x < image.width; ++x) {
      Eigen::Array3f normal;
      for (int c = 0; c < 3; ++c) normal[c] = 2 * image.at(x, y, c) - 1;
      const float up = std::max(normal[2], kMinUp);
      texels[static_cast<std::size_t>(x)] = {normal[0] / up, normal[1] / up, 0};
    }
  };
  return {image.width, image.height, row};
}

ImageRows channel_values_of(const Image& image) {
  const auto row = [&image](int y, std::span<Eigen::Array3f> texels) {
    const bool grey = image.channels < 3;
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        texels[static_cast<std::size_t>(x)][c] = image.at(x, y, grey ? 0 : c);
      }
    }
  };
  return {image.width, image.height, row};
}

}  // namespace crowdface
