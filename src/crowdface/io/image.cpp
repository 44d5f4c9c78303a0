// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/foreign_file.h"
#include "crowdface/io/image_codec.h"
#include "crowdface/io/image_container.h"
#include "crowdface/io/project_library.h"

namespace crowdface {
namespace {

using std::filesystem::path;

/// Rejects files that are unsafe to decode.
/// \return the format's name in OpenImageIO.
std::string checked_format(const path& file, std::string_view bytes, const ImageLimits& limits) {
  const std::string format = image_format(bytes);
  const bool is_inexact = format == "jpeg" || format == "webp";
  if (format.empty() || (is_inexact && !limits.allows_jpeg)) {
    std::string found = describe_numpy_archive(bytes, file);
    if (found.empty()) found = describe_failed_download(bytes);
    if (bytes.empty()) found = "an empty file";
    if (is_inexact) {
      found = concat(format == "jpeg" ? "a JPEG" : "a WebP",
                     " image, whose values are inexact: paint it again and save it as PNG");
    }
    if (found.empty()) {
      found = concat("a file that begins with ", quoted(bytes.substr(0, 8)), ": save it as PNG");
    }
    refuse_file(file, concat("expected a PNG, ", limits.allows_jpeg ? "JPEG, " : "",
                             "TIFF or OpenEXR image, found ", found));
  }
  if (const std::string defect =
          container_defect(format, bytes, limits.max_side, limits.allows_jpeg);
      !defect.empty()) {
    refuse_file(file, defect);
  }
  return format;
}

const ImageCodec& codec_of(std::string_view format) {
  return format == "png" ? png_codec() : image_codec();
}

/// An open image and its header.
struct OpenImage {
  const ImageCodec& codec;
  ImageHeader header;
  /// The content of a Photoshop file without its layers. `picture` reads this content in place of
  /// the file. Null for files of other formats.
  std::unique_ptr<const std::string> rewritten;
  std::unique_ptr<void, void (*)(void*)> picture;
};

void check_size(const path& file, const ImageHeader& spec, const ImageLimits& limits) {
  const auto size =
      concat(spec.width, " x ", spec.height, " pixels of ", spec.channels, " channels");
  if (spec.width < 1 || spec.height < 1 || spec.channels < 1) {
    refuse_file(file, concat("expected at least one pixel and channel, found ", size));
  }
  if (spec.width > limits.max_side || spec.height > limits.max_side) {
    refuse_file(file, concat("expected at most ", limits.max_side, " pixels a side, found ", size));
  }
  const auto most = static_cast<std::int64_t>(input_limits().image_pixels);
  if (!limits.is_crowdface_file && std::int64_t{spec.width} * spec.height > most) {
    refuse_file(file, concat("expected at most ", most, " pixels (--limit), found ", size));
  }
  if (spec.channels > limits.max_channels) {
    refuse_file(file, concat("expected at most ", limits.max_channels, " channels, found ", size));
  }
  if (spec.tile_width > limits.max_side || spec.tile_height > limits.max_side) {
    refuse_file(file, concat("expected tiles of at most ", limits.max_side,
                             " pixels a side, found ", spec.tile_width, " x ", spec.tile_height));
  }
  if (std::int64_t{spec.width} * spec.height * spec.channels > limits.max_values) {
    refuse_file(file,
                concat("expected at most ", limits.max_values, " values in all, found ", size));
  }
}

/// Number of bits that the file stores per pixel; for a palette image, the bits of the index.
/// Expects a valid PNG header that libpng has accepted.
std::uint64_t png_bits_per_pixel(std::string_view bytes) {
  // Samples per pixel for each PNG colour type
  constexpr std::uint64_t kSamples[8] = {1, 0, 3, 1, 2, 0, 4, 0};
  const auto depth = static_cast<unsigned char>(bytes[24]);
  return depth * kSamples[static_cast<unsigned char>(bytes[25]) & 7U];
}

/// Rejects PNG headers that claim more pixels than the file can contain, because memory for all
/// pixels is allocated before decoding. TIFFs are checked before they are opened (`tiff_defect`).
/// For OpenEXR and JPEG, the file size does not limit the number of pixels; only `ImageLimits` and
/// the memory limit for all images do.
void check_png_claim(const path& file, std::string_view bytes, const ImageHeader& spec) {
  constexpr std::uint64_t kMaxOfOneByte = 1100;  // deflate expands a byte to at most 1032 bytes
  const std::uint64_t bits = png_bits_per_pixel(bytes);
  const std::uint64_t row = (static_cast<std::uint64_t>(spec.width) * bits + 7) / 8;
  const std::uint64_t claimed = row * static_cast<std::uint64_t>(spec.height);
  if (claimed <= kMaxOfOneByte * bytes.size() + row) return;
  refuse_file(file,
              concat("is too short for the ", spec.width, " x ", spec.height, " pixels of ", bits,
                     " bits that it claims to hold: expected at least ", claimed / kMaxOfOneByte,
                     " bytes, found ", bytes.size(), " (cut short?)"));
}

void check_kind(const path& file, std::string_view format, const ImageHeader& spec) {
  if (spec.is_deep || spec.depth > 1)
    refuse_file(file, "expected a flat image, found a deep one: save it without depth samples");
  // Only OpenEXR has display windows. In other formats, an image that differs in size from the full
  // image is a crop.
  const bool has_windows = format == "openexr";
  if (!has_windows && (spec.width != spec.full_width || spec.height != spec.full_height)) {
    refuse_file(file, concat("expected the whole image, found ", spec.width, " x ", spec.height,
                             " pixels of ", spec.full_width, " x ", spec.full_height,
                             ": save the whole image"));
  }
}

std::size_t value_count(const ImageHeader& header) {
  return static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) *
         static_cast<std::size_t>(header.channels);
}

template <class T>
void* make_room(Image& image, std::size_t values) {
  std::vector<T>& pixels = image.pixels.emplace<std::vector<T>>();
  pixels.resize(values);
  return pixels.data();
}

void* make_room(const path& file, const ImageHeader& header, Image& image) {
  const std::size_t values = value_count(header);
  using ValueType = ImageHeader::ValueType;
  if (header.value_type == ValueType::kBytes) return make_room<std::uint8_t>(image, values);
  if (header.value_type == ValueType::kWords) return make_room<std::uint16_t>(image, values);
  if (header.value_type == ValueType::kFloats) return make_room<float>(image, values);
  refuse_file(file, concat("expected 8 or 16 bit integers or floats, found ", header.type_name));
}

/// Number of bytes of the decoded pixels. Values of 8 or 16 bits take 1 or 2 bytes each, as in the
/// file; all other values take 4 bytes each.
std::uint64_t pixel_bytes(const ImageHeader& header) {
  const bool bytes = header.value_type == ImageHeader::ValueType::kBytes;
  const bool words = header.value_type == ImageHeader::ValueType::kWords;
  return value_count(header) * (bytes ? 1 : words ? 2 : sizeof(float));
}

std::mutex reservation_mutex;
std::uint64_t reserved_bytes = 0;  ///< number of bytes that are reserved for all images together

/// Number of bytes that can still be reserved if at most `most` bytes may be reserved. The caller
/// must hold the mutex.
std::uint64_t unreserved_bytes(std::uint64_t most) {
  return most - std::min(reserved_bytes, most);
}

void check_finite(const path& file, const Image& image) {
  if (!image.has_floats()) return;
  const auto& pixels = std::get<std::vector<float>>(image.pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (std::isfinite(pixels[i])) continue;
    const auto channels = static_cast<std::size_t>(image.channels);
    const auto width = static_cast<std::size_t>(image.width);
    throw DamagedImage(file, concat(file.string(), ": expected finite values, found ",
                                    pixels[i] != pixels[i] ? "NaN" : "infinity", " at column ",
                                    i / channels % width + 1, ", row ", i / channels / width + 1,
                                    ", channel ", i % channels + 1));
  }
}

/// Encodes an image as a file.
/// \param values  number of values in `picture.pixels`; must be width · height · channels.
std::string encode(const ImageToEncode& picture, std::size_t values) {
  const auto [form, width, height, channels, pixels] = picture;
  const std::string_view format = form == ImageToEncode::Form::kJpeg  ? "jpeg"
                                  : form == ImageToEncode::Form::kExr ? "openexr"
                                                                      : "png";
  require(width > 0 && height > 0 &&
              values == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(channels),
          "an image of ", width, " x ", height, " pixels and ", channels, " channels from ", values,
          " values");
  std::string bytes, error;
  if (!codec_of(format).encode(picture, bytes, error)) {  // pixels that this program computed
    throw_if_interrupted();
    throw IoError(concat(format, ": cannot be encoded (is there too little memory?): ", error));
  }
  return bytes;
}

/// Opens a file. Rejects images that are unsafe to decode and images that are not supported.
OpenImage open_checked(const path& file, const MappedFile& mapped, const ImageLimits& limits) {
  const std::string format = checked_format(file, mapped.bytes(), limits);
  const ImageCodec& codec = codec_of(format);
  OpenImage opened{codec, {}, {}, {nullptr, codec.close}};
  std::string error;
  if (format == "psd")
    opened.rewritten = std::make_unique<const std::string>(flattened_psd(mapped.bytes()));
  opened.picture.reset(codec.open(format, file.string(),
                                  opened.rewritten ? *opened.rewritten : mapped.bytes(),
                                  opened.header, error));
  if (!opened.picture) refuse_file(file, error);
  check_kind(file, format, opened.header);
  check_size(file, opened.header, limits);
  if (format == "png") check_png_claim(file, mapped.bytes(), opened.header);
  return opened;
}

/// Copies the pixels from the data window to the display window; pixels outside the data window are
/// zero.
template <class T>
std::vector<T> in_display_window(const std::vector<T>& pixels, const ImageHeader& header) {
  const auto channels = static_cast<std::size_t>(header.channels);
  const auto width = static_cast<std::size_t>(header.full_width);
  std::vector<T> out(width * static_cast<std::size_t>(header.full_height) * channels, T{});
  using Place = std::int64_t;  // windows may have any offset
  const Place left = std::max(header.x, header.full_x);
  const Place right =
      std::min(Place{header.x} + header.width, Place{header.full_x} + header.full_width);
  const Place bottom =
      std::min(Place{header.y} + header.height, Place{header.full_y} + header.full_height);
  if (left >= right) return out;
  for (Place y = std::max(header.y, header.full_y); y < bottom; ++y) {
    const auto from =
        static_cast<std::size_t>(y - header.y) * static_cast<std::size_t>(header.width) +
        static_cast<std::size_t>(left - header.x);
    const auto to = static_cast<std::size_t>(y - header.full_y) * width +
                    static_cast<std::size_t>(left - header.full_x);
    std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(from * channels),
                static_cast<std::size_t>(right - left) * channels,
                out.begin() + static_cast<std::ptrdiff_t>(to * channels));
  }
  return out;
}

void crop_to_display_window(const path& file, const ImageHeader& header, const ImageLimits& limits,
                            Image& image) {
  if (header.x == header.full_x && header.y == header.full_y && header.width == header.full_width &&
      header.height == header.full_height) {
    return;
  }
  ImageHeader shown = header;
  shown.width = header.full_width;
  shown.height = header.full_height;
  check_size(file, shown, limits);
  const ImageMemory memory =
      limits.is_crowdface_file ? nullptr : reserve_image_memory(file, pixel_bytes(shown));
  std::visit([&](auto& pixels) { pixels = in_display_window(pixels, header); }, image.pixels);
  image.width = header.full_width;
  image.height = header.full_height;
  image.memory = memory;
}

Image decode(const path& file, const MappedFile& mapped, const ImageLimits& limits) {
  const auto [codec, header, rewritten, picture] = open_checked(file, mapped, limits);
  Image image{header.width, header.height,       header.channels, header.alpha_channel, {},
              {},           header.channel_names};
  if (!limits.is_crowdface_file) image.memory = reserve_image_memory(file, pixel_bytes(header));
  std::string error;
  if (!codec.read(picture.get(), make_room(file, header, image), error)) {
    throw_if_interrupted();
    throw DamagedImage(file, concat(file.string(), ": is damaged or cut short: ", error));
  }
  check_finite(file, image);
  crop_to_display_window(file, header, limits, image);
  return image;
}

}  // namespace

const ImageCodec& image_codec() {
  using Function = const ImageCodec*();
  static const ImageCodec& codec = *reinterpret_cast<Function*>(load_library_function(
      "libcrowdface_images.so", "crowdface_image_codec", "images need (OpenImageIO)",
      "images can be neither read nor written"))();
  return codec;
}

ImageMemory reserve_image_memory(const path& file, std::uint64_t bytes) {
  const std::uint64_t most = input_limits().image_bytes;
  {
    const std::lock_guard lock(reservation_mutex);
    const std::uint64_t free = unreserved_bytes(most);
    if (bytes > free) {
      refuse_file(file, concat("its pixels take ", format_bytes(bytes), ", and ",
                               format_bytes(free), " of the ", format_bytes(most),
                               " for all images together are free (--limit image_bytes=NUMBER)"));
    }
    reserved_bytes += bytes;
  }
  return {&reserved_bytes, [bytes](const void*) {
            const std::lock_guard lock(reservation_mutex);
            reserved_bytes -= bytes;
          }};
}

std::uint64_t available_image_memory() {
  const std::lock_guard lock(reservation_mutex);
  return unreserved_bytes(input_limits().image_bytes);
}

Image read_image(const path& file, const ImageLimits& limits) {
  const MappedFile mapped(file);
  try {
    return decode(file, mapped, limits);
  } catch (const InvalidInput&) {
    // Decoders report a temporary lack of memory as damaged data. Decode a second time: if this
    // attempt fails too, the data is damaged.
    try {
      return decode(file, mapped, limits);
    } catch (const InvalidInput& again) {
      if (limits.is_crowdface_file) throw IoError(again.what());
      throw;
    }
  }
}

ImageSize read_image_size(const path& file, const ImageLimits& limits) {
  const MappedFile mapped(file);
  const ImageHeader header = open_checked(file, mapped, limits).header;
  return {header.full_width, header.full_height, header.channels,
          header.value_type == ImageHeader::ValueType::kBytes,
          header.value_type == ImageHeader::ValueType::kFloats};
}

std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels) {
  require(channels > 0 && channels <= 4, "a PNG of ", channels, " channels");
  return encode({ImageToEncode::Form::kPng, width, height, channels, pixels.data()}, pixels.size());
}

std::string encode_jpeg(int width, int height, std::span<const std::uint8_t> pixels) {
  return encode({ImageToEncode::Form::kJpeg, width, height, 3, pixels.data()}, pixels.size());
}

std::string encode_png16(int width, int height, int channels,
                         std::span<const std::uint16_t> pixels) {
  require(channels > 0 && channels <= 4, "a PNG of ", channels, " channels");
  return encode({ImageToEncode::Form::kPng16, width, height, channels, pixels.data()},
                pixels.size());
}

std::string encode_exr(int width, int height, int channels, std::span<const float> pixels) {
  require(channels == 1 || channels == 3, "an OpenEXR of ", channels, " channels");
  return encode({ImageToEncode::Form::kExr, width, height, channels, pixels.data()}, pixels.size());
}

}  // namespace crowdface
