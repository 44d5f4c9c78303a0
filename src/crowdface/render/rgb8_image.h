// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace crowdface {

/// An 8-bit sRGB image with three channels; the first row is the top.
struct Rgb8Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< height · width · 3 values

  Rgb8Image() = default;
  /// An image of one colour.
  Rgb8Image(int width_px, int height_px, std::array<std::uint8_t, 3> colour = {})
      : width(width_px), height(height_px) {
    pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = colour[i % 3];
  }
  std::uint8_t* at(int x, int y) { return pixels.data() + offset(x, y); }
  const std::uint8_t* at(int x, int y) const { return pixels.data() + offset(x, y); }
  bool operator==(const Rgb8Image&) const = default;
  /// Copies `other` into this image, with its upper left corner at (left, top). `other` must fit
  /// completely.
  void paste(const Rgb8Image& other, int left, int top) {
    for (int y = 0; y < other.height; ++y) {
      std::copy_n(other.at(0, y), 3 * other.width, at(left, top + y));
    }
  }

 private:
  /// Index of the first value of a pixel in `pixels`.
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x)) *
           3;
  }
};

}  // namespace crowdface
