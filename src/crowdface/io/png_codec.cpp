// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include <png.h>
#include <zlib.h>

#include "crowdface/core/interrupt.h"
#include "crowdface/io/image_codec.h"
#include "crowdface/io/run_deflate.h"

namespace crowdface {
namespace {

/// The reason why libpng failed. On an error, libpng jumps out with longjmp, so functions between
/// the call and the error must not hold objects with destructors.
struct PngError {
  char text[128] = "";
};

[[noreturn]] void give_up(png_structp png, png_const_charp why) {
  auto& error = *static_cast<PngError*>(png_get_error_ptr(png));
  std::strncpy(error.text, why, sizeof error.text - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*warning*/) {}

/// Called before each row of pixels. After a signal, ends libpng's work with an error; image.cpp
/// then reports the interruption.
void fail_if_interrupted(png_structp png) {
  if (is_interrupted()) png_error(png, "interrupted by a signal");
}

/// Calls `work`, which calls functions of libpng.
/// \return whether libpng finished `work` without an error.
template <class Work>
bool succeeds(png_structp png, const Work& work) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng is C
  work();
  return true;
}

struct OpenPng {
  explicit OpenPng(std::string_view bytes)
      : rest(bytes),
        png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, give_up, ignore_warning)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {}
  ~OpenPng() { png_destroy_read_struct(&png, &info, nullptr); }
  OpenPng(const OpenPng&) = delete;
  OpenPng& operator=(const OpenPng&) = delete;

  std::string_view rest;  ///< the part of the file that is not read yet
  PngError error;
  png_structp png;
  png_infop info;
};

void take_bytes(png_structp png, png_bytep to, std::size_t count) {
  std::string_view& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
  if (rest.size() < count) png_error(png, "it ends too early");
  std::memcpy(to, rest.data(), count);
  rest.remove_prefix(count);
}

void* open_png(const std::string& /*format*/, const std::string& /*file*/, std::string_view bytes,
               ImageHeader& header, std::string& error) {
  auto opened = std::make_unique<OpenPng>(bytes);
  const png_structp png = opened->png;
  const png_infop info = opened->info;
  const bool known = info != nullptr && succeeds(png, [&] {
                       png_set_read_fn(png, &opened->rest, take_bytes);
                       png_read_info(png, info);
                       // Convert palette indices to colours, depths below 8 bits to 8 bits, and a
                       // transparent colour to alpha
                       png_set_expand(png);
                       png_set_swap(png);
                       png_set_interlace_handling(png);
                       png_read_update_info(png, info);
                     });
  if (!known) {
    error = std::string("cannot be read as png: ") + opened->error.text;
    return nullptr;
  }
  header.width = header.full_width = static_cast<int>(png_get_image_width(png, info));
  header.height = header.full_height = static_cast<int>(png_get_image_height(png, info));
  header.channels = png_get_channels(png, info);
  header.alpha_channel = header.channels % 2 == 0 ? header.channels - 1 : -1;
  const bool words = png_get_bit_depth(png, info) == 16;
  header.value_type = words ? ImageHeader::ValueType::kWords : ImageHeader::ValueType::kBytes;
  return opened.release();
}

bool read_png(void* picture, void* pixels, std::string& error) {
  OpenPng& opened = *static_cast<OpenPng*>(picture);
  const png_structp png = opened.png;
  const bool read = succeeds(png, [&] {
    const std::size_t row = png_get_rowbytes(png, opened.info);
    const png_uint_32 height = png_get_image_height(png, opened.info);
    const bool interlaced = png_get_interlace_type(png, opened.info) != PNG_INTERLACE_NONE;
    const int passes = interlaced ? PNG_INTERLACE_ADAM7_PASSES : 1;
    for (int pass = 0; pass < passes; ++pass) {
      for (png_uint_32 y = 0; y < height; ++y) {
        fail_if_interrupted(png);
        png_read_row(png, static_cast<png_bytep>(pixels) + y * row, nullptr);
      }
    }
  });
  if (!read) error = opened.error.text;
  return read;
}

void close_png(void* picture) {
  delete static_cast<OpenPng*>(picture);
}

/// Applies the PNG filter Paeth: each byte of a row becomes its difference from the byte to the
/// left, above, or above left, whichever is nearest to left + above − above left. The filter of
/// libpng takes several times as long.
/// \param row, above  `size` bytes each, after `pixel_bytes` bytes that are 0
void filter_paeth(const std::uint8_t* row, const std::uint8_t* above, std::size_t pixel_bytes,
                  std::size_t size, std::uint8_t* filtered) {
  const std::uint8_t *left = row - pixel_bytes, *above_left = above - pixel_bytes;
  for (std::size_t i = 0; i < size; ++i) {
    const std::int16_t a = left[i], b = above[i], c = above_left[i];
    const auto from_a = static_cast<std::int16_t>(std::abs(b - c));
    const auto from_b = static_cast<std::int16_t>(std::abs(a - c));
    const auto from_c = static_cast<std::int16_t>(std::abs(a + b - 2 * c));
    const std::int16_t b_or_c = from_b <= from_c ? b : c;
    const std::int16_t nearest = from_a <= from_b && from_a <= from_c ? a : b_or_c;
    filtered[i] = static_cast<std::uint8_t>(row[i] - nearest);
  }
}

std::string big_endian(std::size_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(number >> shift));
  return bytes;
}

void append_chunk(std::string_view type, std::string_view data, std::string& file) {
  file.append(big_endian(data.size()));
  const std::size_t begin = file.size();  // of the bytes that the checksum covers
  file.append(type).append(data);
  const auto* bytes = reinterpret_cast<const Bytef*>(file.data() + begin);
  file.append(big_endian(crc32_z(0, bytes, file.size() - begin)));
}

/// Filters and compresses the rows of an image.
/// \return false if the process was interrupted
bool compress_rows(const ImageToEncode& picture, std::string& compressed) {
  const bool has_words = picture.form == ImageToEncode::Form::kPng16;
  const std::size_t pixel_bytes = static_cast<std::size_t>(picture.channels) * (has_words ? 2 : 1);
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(picture.width);
  const auto* pixels = static_cast<const std::uint8_t*>(picture.pixels);
  // `row` and `above` each hold `pixel_bytes` zeros, followed by a row of the image. `filtered`
  // holds the number of the filter, followed by the filtered row.
  std::vector<std::uint8_t> row(pixel_bytes + row_bytes), above(row.size()),
      filtered(1 + row_bytes);
  filtered[0] = PNG_FILTER_VALUE_PAETH;
  RunDeflater deflater(compressed);
  for (int y = 0; y < picture.height; ++y, pixels += row_bytes) {
    if (is_interrupted()) return false;
    std::swap(row, above);
    std::copy_n(pixels, row_bytes, row.data() + pixel_bytes);
    if (has_words) {  // big-endian in the file
      for (std::size_t i = pixel_bytes; i < row.size(); i += 2) std::swap(row[i], row[i + 1]);
    }
    filter_paeth(row.data() + pixel_bytes, above.data() + pixel_bytes, pixel_bytes, row_bytes,
                 filtered.data() + 1);
    deflater.add(filtered);
  }
  deflater.finish();
  return true;
}

bool write_png(const ImageToEncode& picture, std::string& bytes, std::string& error) {
  constexpr char kColourTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                   PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  std::string header = big_endian(static_cast<std::size_t>(picture.width)) +
                       big_endian(static_cast<std::size_t>(picture.height));
  header.push_back(picture.form == ImageToEncode::Form::kPng16 ? 16 : 8);
  header.push_back(kColourTypes[picture.channels - 1]);
  header.append(3, '\0');  // the only methods of compression and filtering; no interlacing
  std::string rows;
  if (!compress_rows(picture, rows)) {
    error = "interrupted by a signal";
    return false;
  }
  bytes = "\x89PNG\r\n\x1a\n";
  append_chunk("IHDR", header, bytes);
  constexpr std::size_t kMaxChunk = std::size_t{1} << 30;
  for (std::size_t at = 0; at < rows.size(); at += kMaxChunk) {
    append_chunk("IDAT", std::string_view(rows).substr(at, kMaxChunk), bytes);
  }
  append_chunk("IEND", {}, bytes);
  return true;
}

}  // namespace

const ImageCodec& png_codec() {
  static constexpr ImageCodec kCodec = {open_png, read_png, close_png, write_png};
  return kCodec;
}

}  // namespace crowdface
