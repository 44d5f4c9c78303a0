// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/image_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>

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

/// Reads the first three channels of a row, as `Image::at` does; a grey image's first channel three
/// times.
void read_channels(const Image& image, int y, std::span<Eigen::Array3f> texels) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto read = [&](const auto& numbers) {
    using Number = std::decay_t<decltype(numbers[0])>;
    constexpr float kOne = std::is_integral_v<Number> ? std::numeric_limits<Number>::max() : 1;
    const Number* at = numbers.data() + static_cast<std::size_t>(y) * texels.size() * channels;
    for (Eigen::Array3f& texel : texels) {
      for (std::size_t c = 0; c < 3; ++c) {
        texel[static_cast<Index>(c)] = static_cast<float>(at[channels < 3 ? 0 : c]) / kOne;
      }
      at += channels;
    }
  };
  std::visit(read, image.pixels);
}

}  // namespace

ImageRows linear_light_of(const Image& image) {
  const auto row = [&image, &table = light_of_srgb16()](int y, std::span<Eigen::Array3f> texels) {
    read_channels(image, y, texels);
    for (Eigen::Array3f& texel : texels) {
      for (float& value : texel) {
        value = image.has_floats() ? std::max(value, 0.0F)
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
    read_channels(image, y, texels);
    for (Eigen::Array3f& texel : texels) {
      const Eigen::Array3f normal = 2 * texel - 1;
      const float up = std::max(normal[2], kMinUp);
      texel = {normal[0] / up, normal[1] / up, 0};
    }
  };
  return {image.width, image.height, row};
}

ImageRows channel_values_of(const Image& image) {
  const auto row = [&image](int y, std::span<Eigen::Array3f> texels) {
    read_channels(image, y, texels);
  };
  return {image.width, image.height, row};
}

}  // namespace crowdface
