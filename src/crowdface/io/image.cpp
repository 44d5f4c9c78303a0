// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image_container.h"

namespace crowdface {
namespace {

using std::filesystem::path;

[[noreturn]] void refuse(const path& file, const std::string& what) {
  throw InvalidInput(concat(file.string(), ": ", what));
}

/// \return the format's name in OpenImageIO; files that no decoder should see are refused.
std::string checked_format(const path& file, std::string_view bytes, const ImageLimits& limits) {
  std::string format = image_format(bytes);
  if (limits.jpeg && bytes.starts_with("\xFF\xD8\xFF")) format = "jpeg";
  if (format.empty()) {
    refuse(file, concat("expected a PNG, TIFF or OpenEXR image, found ",
                        bytes.empty() ? "an empty file"
                                      : "a file that begins with " + quoted(bytes.substr(0, 8))));
  }
  if (const std::string defect = container_defect(format, bytes, limits.max_side, limits.jpeg);
      !defect.empty()) {
    refuse(file, defect);
  }
  return format;
}

/// \param bytes  of the file, as it is mapped: decoders that read files themselves take a disk that fails
///               for a file that is damaged.
std::unique_ptr<OIIO::ImageInput> open(const path& file, const std::string& format,
                                       OIIO::Filesystem::IOMemReader& bytes,
                                       OIIO::ImageSpec& spec) {
  auto input = OIIO::ImageInput::create(format);
  if (!input) refuse(file, concat("this build reads no ", format, ": ", OIIO::geterror()));
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);  // colours under alpha 0 must survive
  input->threads(1);
  if (!input->set_ioproxy(&bytes))
    refuse(file, concat("this build reads no ", format, " from memory"));
  if (!input->open(file.string(), spec, wish)) {
    refuse(file, concat("cannot be read as ", format, ": ", input->geterror()));
  }
  return input;
}

void check_size(const path& file, const OIIO::ImageSpec& spec, const ImageLimits& limits) {
  const auto size =
      concat(spec.width, " x ", spec.height, " pixels of ", spec.nchannels, " channels");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) {
    refuse(file, concat("expected at least one pixel and channel, found ", size));
  }
  if (spec.width > limits.max_side || spec.height > limits.max_side) {
    refuse(file, concat("expected at most ", limits.max_side, " pixels a side, found ", size));
  }
  const auto most = static_cast<std::int64_t>(input_limits().image_pixels);
  if (!limits.ours && std::int64_t{spec.width} * spec.height > most) {
    refuse(file, concat("expected at most ", most, " pixels (--limit), found ", size));
  }
  if (spec.nchannels > limits.max_channels) {
    refuse(file, concat("expected at most ", limits.max_channels, " channels, found ", size));
  }
  if (spec.tile_width > limits.max_side || spec.tile_height > limits.max_side) {
    refuse(file, concat("expected tiles of at most ", limits.max_side, " pixels a side, found ",
                        spec.tile_width, " x ", spec.tile_height));
  }
  if (std::int64_t{spec.width} * spec.height * spec.nchannels > limits.max_values) {
    refuse(file, concat("expected at most ", limits.max_values, " values in all, found ", size));
  }
}

/// Of a PNG that libpng has opened, whose header is sound; before its palette is resolved.
std::uint64_t png_bits_per_pixel(std::string_view bytes) {
  constexpr std::uint64_t kSamples[8] = {1, 0, 3, 1, 2, 0, 4, 0};  // of each colour type
  const auto depth = static_cast<unsigned char>(bytes[24]);
  return depth * kSamples[static_cast<unsigned char>(bytes[25]) & 7U];
}

/// Memory is taken for all pixels before the first is decoded, so a header may not claim more than
/// the file can hold. TIFFs are looked at before they are opened (tiff_defect); OpenEXR and JPEG have
/// no such bound, only that of all images' memory.
void check_png_claim(const path& file, std::string_view bytes, const OIIO::ImageSpec& spec) {
  constexpr std::uint64_t kMostOfOneByte = 1100;  // deflate's longest match takes 2 bits: 1032
  const std::uint64_t bits = png_bits_per_pixel(bytes);
  const std::uint64_t row = (static_cast<std::uint64_t>(spec.width) * bits + 7) / 8;
  const std::uint64_t claimed = row * static_cast<std::uint64_t>(spec.height);
  if (claimed <= kMostOfOneByte * bytes.size() + row) return;
  refuse(file, concat("is too short for the ", spec.width, " x ", spec.height, " pixels of ", bits,
                      " bits that it claims to hold: expected at least ", claimed / kMostOfOneByte,
                      " bytes, found ", bytes.size(), " (cut short?)"));
}

void check_kind(const path& file, std::string_view format, const OIIO::ImageSpec& spec) {
  if (spec.deep || spec.depth > 1) refuse(file, "expected a flat image, found a deep one");
  // Only OpenEXR has a window to lie in; the offsets of others say where the picture was cut from.
  const bool moved = format == "openexr" && (spec.x != spec.full_x || spec.y != spec.full_y);
  if (moved || spec.width != spec.full_width || spec.height != spec.full_height) {
    refuse(file,
           concat("expected all of the picture, found ", spec.width, " x ", spec.height,
                  " pixels at ", spec.x, ", ", spec.y, " of a display window of ", spec.full_width,
                  " x ", spec.full_height, " at ", spec.full_x, ", ", spec.full_y));
  }
}

/// Strips of a TIFF are decoded a row at a time: when the decoder takes several at once, it hides that
/// one of them is damaged. (Where planes lie apart it does not, and rows would be read again for each.)
bool by_rows(const OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
  return std::string_view(input.format_name()) == "tiff" && spec.tile_width == 0 &&
         spec.get_string_attribute("planarconfig") != "separate";
}

template <class T>
void read_pixels(OIIO::ImageInput& input, const path& file, Image& image) {
  const OIIO::ImageSpec& spec = input.spec();
  const auto row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
  const std::size_t values = row * static_cast<std::size_t>(spec.height);
  std::vector<T>& pixels = image.pixels.emplace<std::vector<T>>();
  pixels.resize(values);
  constexpr OIIO::TypeDesc kType = OIIO::BaseTypeFromC<T>::value;
  bool read = true;
  if (by_rows(input, spec)) {
    for (int y = 0; read && y < spec.height; ++y) {
      read = input.read_scanline(spec.y + y, 0, kType,
                                 pixels.data() + row * static_cast<std::size_t>(y));
    }
  } else {
    read = input.read_image(0, 0, 0, -1, kType, pixels.data());
  }
  // Of some damage the decoder says only that it was there.
  if (!read || input.has_error()) {
    refuse(file, concat("is damaged or cut short: ", input.geterror()));
  }
}

void read_pixels(OIIO::ImageInput& input, const path& file, Image& image) {
  const OIIO::TypeDesc type = input.spec().format;
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
      return read_pixels<std::uint8_t>(input, file, image);
    case OIIO::TypeDesc::UINT16:
      return read_pixels<std::uint16_t>(input, file, image);
    case OIIO::TypeDesc::HALF:
    case OIIO::TypeDesc::FLOAT:
    case OIIO::TypeDesc::DOUBLE:
      return read_pixels<float>(input, file, image);
    default:
      refuse(file, concat("expected 8 or 16 bit integers or floats, found ", type.c_str()));
  }
}

/// Bytes that the pixels take, those of integers in their own type.
std::uint64_t pixel_bytes(const OIIO::ImageSpec& spec) {
  const std::size_t of_value = std::min<std::size_t>(spec.format.basesize(), sizeof(float));
  return static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) *
         static_cast<std::uint64_t>(spec.nchannels) *
         (spec.format.is_floating_point() ? sizeof(float) : of_value);
}

void check_finite(const path& file, const Image& image) {
  if (!image.of_floats()) return;
  const auto& pixels = std::get<std::vector<float>>(image.pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (std::isfinite(pixels[i])) continue;
    const auto channels = static_cast<std::size_t>(image.channels);
    const auto width = static_cast<std::size_t>(image.width);
    refuse(file,
           concat("expected finite values, found ", pixels[i] != pixels[i] ? "NaN" : "infinity",
                  " at column ", i / channels % width + 1, ", row ", i / channels / width + 1,
                  ", channel ", i % channels + 1));
  }
}

void require_size(int width, int height, int channels, std::size_t values) {
  require(width > 0 && height > 0 &&
              values == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(channels),
          "an image of ", width, " x ", height, " pixels and ", channels, " channels from ", values,
          " values");
}

/// Pixels of ours can be encoded, unless memory runs out.
constexpr const char* kNotEncoded = "cannot be encoded (is there too little memory?): ";

/// \param format  the writer's name in OpenImageIO.
std::string encode(const std::string& format, const OIIO::ImageSpec& spec,
                   const OIIO::TypeDesc& type, const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  auto output = OIIO::ImageOutput::create(format);
  if (!output) throw IoError(concat(format, ": ", kNotEncoded, OIIO::geterror()));
  output->set_ioproxy(&memory);
  if (!output->open("memory." + format, spec) || !output->write_image(type, pixels) ||
      !output->close()) {
    throw IoError(concat(format, ": ", kNotEncoded, output->geterror()));
  }
  return {bytes.begin(), bytes.end()};
}

/// Opens a file and refuses what should not be decoded.
std::unique_ptr<OIIO::ImageInput> open_checked(const path& file, const MappedFile& mapped,
                                               OIIO::Filesystem::IOMemReader& bytes,
                                               const ImageLimits& limits, OIIO::ImageSpec& spec) {
  const std::string format = checked_format(file, mapped.bytes(), limits);
  auto input = open(file, format, bytes, spec);
  check_kind(file, format, spec);
  check_size(file, spec, limits);
  if (format == "png") check_png_claim(file, mapped.bytes(), spec);
  return input;
}

Image decode(const path& file, const MappedFile& mapped, const ImageLimits& limits) {
  OIIO::ImageSpec spec;
  OIIO::Filesystem::IOMemReader bytes(mapped.bytes().data(), mapped.bytes().size());
  const auto input = open_checked(file, mapped, bytes, limits, spec);
  Image image{spec.width, spec.height, spec.nchannels, spec.alpha_channel, {}, {}};
  if (!limits.ours) image.memory = take_image_memory(file, pixel_bytes(spec));
  read_pixels(*input, file, image);
  check_finite(file, image);
  return image;
}

}  // namespace

Image read_image(const path& file, const ImageLimits& limits) {
  const MappedFile mapped(file);
  try {
    return decode(file, mapped, limits);
  } catch (const InvalidInput&) {
    // Decoders tell a lack of memory as damage; what is damaged is so every time.
    try {
      return decode(file, mapped, limits);
    } catch (const InvalidInput& again) {
      if (limits.ours) throw IoError(again.what());
      throw;
    }
  }
}

ImageSize read_image_size(const path& file, const ImageLimits& limits) {
  const MappedFile mapped(file);
  OIIO::ImageSpec spec;
  OIIO::Filesystem::IOMemReader bytes(mapped.bytes().data(), mapped.bytes().size());
  open_checked(file, mapped, bytes, limits, spec);
  return {spec.width, spec.height};
}

std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                       PngEffort effort) {
  require(channels > 0 && channels <= 4, "a PNG of ", channels, " channels");
  require_size(width, height, channels, pixels.size());
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec.alpha_channel = channels % 2 == 0 ? channels - 1 : -1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (effort == PngEffort::kFast) spec.attribute("png:compressionLevel", 1);
  return encode("png", spec, OIIO::TypeDesc::UINT8, pixels.data());
}

std::string encode_jpeg(int width, int height, std::span<const std::uint8_t> pixels) {
  require_size(width, height, 3, pixels.size());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", "jpeg:92");
  spec.attribute("jpeg:subsampling", "4:4:4");
  return encode("jpeg", spec, OIIO::TypeDesc::UINT8, pixels.data());
}

std::string encode_exr(int width, int height, std::span<const float> pixels) {
  require_size(width, height, 3, pixels.size());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::HALF);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "linear");
  spec.attribute("DateTime", "2000:01:01 00:00:00");  // else the time of writing
  return encode("openexr", spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

}  // namespace crowdface
