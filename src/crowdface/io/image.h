// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "crowdface/core/error.h"

namespace crowdface {

/// A reservation of memory for an image. All reservations together are at most
/// `input_limits().image_bytes`. A reservation ends when its last owner is destroyed.
using ImageMemory = std::shared_ptr<const void>;

/// Reserves memory for an image. Thread-safe.
/// \throws InvalidInput, naming the file, if all images together would exceed the limit.
ImageMemory reserve_image_memory(const std::filesystem::path& file, std::uint64_t bytes);

/// Number of bytes that can still be reserved for images.
std::uint64_t available_image_memory();

/// An image with the exact values of the file: the value type of the file, no gamma conversion,
/// alpha not premultiplied.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  int alpha_channel = -1;  ///< index of the alpha channel; −1: none
  /// The pixels row by row, top row first. The channels of each pixel are next to each other.
  std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>> pixels;
  ImageMemory memory = {};  ///< memory reserved for `pixels`; null: no memory is reserved
  /// One name per channel; empty if the format does not name channels.
  std::vector<std::string> channel_names = {};

  /// Whether the values are single-precision numbers; otherwise they are integers.
  bool has_floats() const { return pixels.index() == 0; }

  /// The value of one channel of a pixel. Integers become fractions of their maximum, by division:
  /// multiplication by a rounded 1/255 would give slightly different values.
  float at(int x, int y, int channel) const {
    const std::size_t i = (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)) *
                              static_cast<std::size_t>(channels) +
                          static_cast<std::size_t>(channel);
    if (const auto* bytes = std::get_if<1>(&pixels))
      return static_cast<float>((*bytes)[i]) / 255.0F;
    if (const auto* words = std::get_if<2>(&pixels)) {
      return static_cast<float>((*words)[i]) / 65535.0F;
    }
    return std::get<0>(pixels)[i];
  }
};

/// Limits of image size. Larger images are rejected before memory is allocated for pixels.
struct ImageLimits {
  int max_side = 16384;  ///< maximum of the width and of the height, in pixels
  int max_channels = 16;
  std::int64_t max_values = 1LL << 30U;  ///< maximum of width · height · channels
  /// Whether to accept formats with lossy compression, JPEG and WebP: true for colour textures,
  /// false for masks.
  bool allows_jpeg = false;
  /// Whether crowdface itself wrote the file, so that `input_limits()` does not apply.
  bool is_crowdface_file = false;
};

/// Thrown if the header of a file is valid but the pixels are damaged.
class DamagedImage : public InvalidInput {
 public:
  DamagedImage(std::filesystem::path image, const std::string& what)
      : InvalidInput(what), path(std::move(image)) {}
  std::filesystem::path path;
};

/// Reads the image (if there are several, the first) of a PNG, TIFF, OpenEXR, TGA, BMP, GIF or
/// Photoshop file. The content, not the file name, determines the format. Palette indices become
/// colours; alpha and colours keep the values of the file. For EXR the result is the display
/// window; pixels outside the data window are zero.
/// A TIFF may be uncompressed, or compressed with LZW, Deflate, PackBits or, with `allows_jpeg`,
/// JPEG.
/// \throws MissingInput if the file does not exist; DamagedImage if the pixels cannot be read or a
/// value is not finite (the message names the first such pixel); InvalidInput if the format or
/// compression is unsupported, the file is truncated or exceeds the limits, integers have more than
/// 16 bits, or all images together would exceed the memory limit.
Image read_image(const std::filesystem::path& path, const ImageLimits& limits = {});

/// Size and value type of the image that `read_image` would return.
struct ImageSize {
  int width = 0;
  int height = 0;
  int channels = 0;
  // If has_8_bit_values and has_floats are false, the values are 16-bit integers.
  bool has_8_bit_values = false;  ///< whether the values are 8-bit integers
  bool has_floats = false;        ///< whether the values are single-precision numbers
};
/// Reads the header of an image file, without decoding pixels.
/// \throws MissingInput, InvalidInput.
ImageSize read_image_size(const std::filesystem::path& path, const ImageLimits& limits = {});

/// Encodes an 8-bit PNG file in memory. Equal pixels give equal bytes; the file has no time stamp.
/// \param channels  1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha is not premultiplied.
/// \param pixels  height · width · channels values.
/// \throws BrokenPrecondition if the sizes do not match.
std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels);

/// Encodes a PNG with 16 bits per value.
std::string encode_png16(int width, int height, int channels,
                         std::span<const std::uint16_t> pixels);

/// Encodes a JPEG file in memory: 8-bit RGB, quality 92, no chroma subsampling.
/// \param pixels  height · width · 3 values.
/// \throws BrokenPrecondition if the sizes do not match.
std::string encode_jpeg(int width, int height, std::span<const std::uint8_t> pixels);

/// Encodes an OpenEXR file in memory: 16-bit floats, linear, no time stamp.
/// \param pixels  height · width · channels values.
/// \throws BrokenPrecondition if the sizes do not match.
std::string encode_exr(int width, int height, int channels, std::span<const float> pixels);

}  // namespace crowdface
