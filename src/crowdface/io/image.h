// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace crowdface {

/// The plain numbers of an image: no gamma, no alpha premultiplication. 8 and 16 bit integers as
/// value/255 and value/65535, floats as they are.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  int alpha_channel = -1;     ///< which channel is alpha; −1: none
  std::vector<float> pixels;  ///< row by row, first row on top, channels of a pixel side by side
  bool of_floats = false;     ///< the file holds floats, not integers

  float at(int x, int y, int channel) const {
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    return pixels[(row + static_cast<std::size_t>(x)) * static_cast<std::size_t>(channels) +
                  static_cast<std::size_t>(channel)];
  }
};

/// What is still read; larger images are refused before memory is taken.
struct ImageLimits {
  int max_side = 16384;  ///< pixels
  int max_channels = 16;
  std::int64_t max_values = 1LL << 30U;  ///< width · height · channels
  bool jpeg = false;                     ///< that too: for colours, never for masks
  bool ours = false;                     ///< we wrote it: input_limits() are not asked
};

/// The (first) picture of a PNG, TIFF or OpenEXR file, told by its content and not by its name.
/// Palettes are resolved; alpha and colours stay as they stand in the file.
/// \throws MissingInput if there is no such file; InvalidInput if it is of another format, damaged
///         or cut, beyond the limits, of integers of more than 16 bits, an EXR of which only a part
///         is stored, or if a value is not finite (the first such pixel is named).
Image read_image(const std::filesystem::path& path, const ImageLimits& limits = {});

/// An 8-bit PNG file in memory: the same bytes for the same pixels, no time stamp.
/// \param channels  1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha is not premultiplied.
/// \param pixels    height · width · channels.
/// \throws BrokenPrecondition if sizes do not fit.
std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels);

/// An OpenEXR file in memory: three channels of 16-bit floats, linear, no time stamp.
/// \param pixels  height · width · 3.
/// \throws BrokenPrecondition if sizes do not fit.
std::string encode_exr(int width, int height, std::span<const float> pixels);

}  // namespace crowdface
