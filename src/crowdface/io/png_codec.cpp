// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/png_codec.h"

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <new>

#include <png.h>

#include "crowdface/core/interrupt.h"

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

struct MadePng {
  explicit MadePng(std::string& written)
      : bytes(written),
        png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, give_up, ignore_warning)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {}
  ~MadePng() { png_destroy_write_struct(&png, &info); }
  MadePng(const MadePng&) = delete;
  MadePng& operator=(const MadePng&) = delete;

  std::string& bytes;
  PngError error;
  png_structp png;
  png_infop info;
};

void give_bytes(png_structp png, png_bytep from, std::size_t count) {
  bool have_room = true;
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(from), count);
  } catch (const std::bad_alloc&) {
    have_room = false;
  }
  if (!have_room) png_error(png, "out of memory");
}

void flush_nothing(png_structp /*png*/) {}

/// Sets the compression. Files of face images are at most 7 % larger than with the highest
/// compression levels of zlib, and encoding takes a quarter of the time.
void set_compression(png_structp png, ImageToEncode::Form form) {
  if (form == ImageToEncode::Form::kUncompressedPng) {
    png_set_compression_level(png, 0);
    return png_set_filter(png, 0, PNG_FILTER_NONE);
  }
  constexpr int kRuns = 3;  // Z_RLE: matches only runs of equal bytes
  png_set_compression_strategy(png, kRuns);
  png_set_compression_level(png, 1);
  png_set_filter(png, 0, PNG_FILTER_PAETH);  // by default libpng tries all five filters per row
}

bool write_png(const ImageToEncode& picture, std::string& bytes, std::string& error) {
  constexpr int kColourTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                  PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  const int bits = picture.form == ImageToEncode::Form::kPng16 ? 16 : 8;
  const std::size_t row = static_cast<std::size_t>(picture.width) *
                          static_cast<std::size_t>(picture.channels * bits / 8);
  MadePng made(bytes);
  const png_structp png = made.png;
  const png_infop info = made.info;
  const bool written = info != nullptr && succeeds(png, [&] {
                         png_set_write_fn(png, &made.bytes, give_bytes, flush_nothing);
                         set_compression(png, picture.form);
                         png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width),
                                      static_cast<png_uint_32>(picture.height), bits,
                                      kColourTypes[picture.channels - 1], PNG_INTERLACE_NONE,
                                      PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
                         png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
                         png_write_info(png, info);
                         if (bits == 16) png_set_swap(png);
                         for (int y = 0; y < picture.height; ++y) {
                           fail_if_interrupted(png);
                           png_write_row(png, static_cast<png_const_bytep>(picture.pixels) +
                                                  static_cast<std::size_t>(y) * row);
                         }
                         png_write_end(png, info);
                       });
  if (!written) error = made.error.text;
  return written;
}

}  // namespace

const ImageCodec& png_codec() {
  static constexpr ImageCodec kCodec = {open_png, read_png, close_png, write_png};
  return kCodec;
}

}  // namespace crowdface
