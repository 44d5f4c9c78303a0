// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/light_of_image.h"

#include <algorithm>
#include <cmath>

#include "crowdface/render/shading.h"

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

}  // namespace

LightRows light_of(const Image& image) {
  const auto row = [&image, &table = light_of_srgb16()](int y, std::span<Eigen::Array3f> texels) {
    const bool grey = image.channels < 3;
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, grey ? 0 : c);
        texels[static_cast<std::size_t>(x)][c] =
            image.of_floats() ? std::max(value, 0.0F)
                              : table[static_cast<std::size_t>(std::lround(65535.0F * value))];
      }
    }
  };
  return {image.width, image.height, row};
}

LightRows slopes_of(const Image& image) {
  const auto row = [&image](int y, std::span<Eigen::Array3f> texels) {
    constexpr float kLeastUp = 1.0F / 8;  // MapCoding::slopes() has room for no more
    for (int x = 0; x < image.width; ++x) {
      Eigen::Array3f normal;
      for (int c = 0; c < 3; ++c) normal[c] = 2 * image.at(x, y, c) - 1;
      const float up = std::max(normal[2], kLeastUp);
      texels[static_cast<std::size_t>(x)] = {normal[0] / up, normal[1] / up, 0};
    }
  };
  return {image.width, image.height, row};
}

LightRows values_of(const Image& image) {
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
