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

/// A share of the memory that all images together may take (input_limits().image_bytes): it is given
/// back when nobody holds it any more.
using ImageMemory = std::shared_ptr<const void>;

/// Any thread may ask. \throws InvalidInput, naming the file, if all images would take too much.
ImageMemory take_image_memory(const std::filesystem::path& file, std::uint64_t bytes);

/// What of it nobody holds at present.
std::uint64_t free_image_memory();

/// The plain numbers of an image, no gamma, no alpha premultiplication, in the type of the file.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  int alpha_channel = -1;  ///< which channel is alpha; −1: none
  /// Row by row, first row on top, channels of a pixel side by side.
  std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>> pixels;
  ImageMemory memory = {};
  std::vector<std::string> channel_names = {};  ///< #channels, if the format has any

  bool of_floats() const { return pixels.index() == 0; }

  /// Integers as fractions of the largest: divided, not multiplied by a rounded 1/255.
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

/// What is still read; larger images are refused before memory is taken.
struct ImageLimits {
  int max_side = 16384;  ///< pixels
  int max_channels = 16;
  std::int64_t max_values = 1LL << 30U;  ///< width · height · channels
  bool jpeg = false;                     ///< that too: for colours, never for masks
  bool ours = false;                     ///< we wrote it: input_limits() are not asked
};

/// What seemed an image turned out to be damaged when its pixels were read.
class DamagedImage : public InvalidInput {
 public:
  DamagedImage(std::filesystem::path image, const std::string& what)
      : InvalidInput(what), path(std::move(image)) {}
  std::filesystem::path path;
};

/// The (first) picture of a PNG, TIFF or OpenEXR file, told by its content and not by its name.
/// Palettes are resolved; alpha and colours stay as they stand in the file. Of an EXR the display window is read: outside
/// the data window it is zero.
/// \throws MissingInput if there is no such file; DamagedImage if its pixels cannot be read or one
///         is not finite (the first is named); InvalidInput if it is of another format, cut, beyond
///         the limits, of integers of more than 16 bits, a
///         TIFF of another compression than none, LZW, Deflate and PackBits (with `jpeg`: JPEG
///         too), or if all images together would take more memory than they may.
Image read_image(const std::filesystem::path& path, const ImageLimits& limits = {});

/// What read_image would find, without decoding it. \throws as it does.
struct ImageSize {
  int width = 0;
  int height = 0;
  int channels = 0;
  bool of_bytes = false;   ///< 8 bits a value
  bool of_floats = false;  ///< neither: 16 bits
};
ImageSize read_image_size(const std::filesystem::path& path, const ImageLimits& limits = {});

/// An 8-bit PNG file in memory: the same bytes for the same pixels, no time stamp.
/// \param channels  1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha is not premultiplied.
/// \param pixels    height · width · channels.
/// \throws BrokenPrecondition if sizes do not fit.
std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels);

/// A PNG that is not packed: its bytes depend on the pixels alone, and not on the zlib of the machine.
std::string encode_stored_png(int width, int height, std::span<const std::uint8_t> pixels);

/// Of 16 bits.
std::string encode_png16(int width, int height, int channels,
                         std::span<const std::uint16_t> pixels);

/// A JPEG file in memory: 8-bit RGB, quality 92, colours not subsampled.
/// \param pixels  height · width · 3. \throws BrokenPrecondition if sizes do not fit.
std::string encode_jpeg(int width, int height, std::span<const std::uint8_t> pixels);

/// An OpenEXR file in memory: channels of 16-bit floats, linear, no time stamp.
/// \param pixels  height · width · channels.
/// \throws BrokenPrecondition if sizes do not fit.
std::string encode_exr(int width, int height, int channels, std::span<const float> pixels);

}  // namespace crowdface
