// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <variant>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include "crowdface/io/image.h"
#include "crowdface/io/image_codec.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr int kWidth = 21, kHeight = 11;

struct PngForm {
  int colour_type, bits, interlace;
  bool transparent;  ///< a colour, or a palette's first
};

/// Any pixels of that form.
void write(const fs::path& file, const PngForm& form) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, out);
  png_set_IHDR(png, info, kWidth, kHeight, form.bits, form.colour_type, form.interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette(std::size_t{1} << std::min(form.bits, 8));
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const auto value = static_cast<png_byte>(i);
    palette[i] = {value, static_cast<png_byte>(3 * value), static_cast<png_byte>(200 - value)};
  }
  if (form.colour_type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  }
  const png_byte alpha = 40;
  const png_color_16 colour = {0, 1, 1, 1, 1};
  if (form.transparent) png_set_tRNS(png, info, &alpha, 1, &colour);
  png_write_info(png, info);
  std::vector<png_byte> row(png_get_rowbytes(png, info));
  for (int pass = png_set_interlace_handling(png); pass > 0; --pass) {
    for (int y = 0; y < kHeight; ++y) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = static_cast<png_byte>(i % 3 == 0 ? 1 : 37 * i + 11 * static_cast<std::size_t>(y));
      }
      png_write_row(png, row.data());
    }
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(out);
}

template <class Value>
void expect_same_as_openimageio(const fs::path& file, const Image& image) {
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &wish);
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(image.width, spec.width);
  EXPECT_EQ(image.height, spec.height);
  EXPECT_EQ(image.channels, spec.nchannels);
  EXPECT_EQ(image.alpha_channel, spec.alpha_channel);
  ASSERT_EQ(spec.format, OIIO::TypeDesc(OIIO::BaseTypeFromC<Value>::value));
  std::vector<Value> pixels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  ASSERT_TRUE(input->read_image(0, 0, 0, -1, spec.format, pixels.data()));
  EXPECT_EQ(std::get<std::vector<Value>>(image.pixels), pixels);
}

TEST(PngCodec, ReadsEveryFormAsOpenImageIODoes) {
  const TemporaryFolder folder;
  const fs::path file = folder / "any.png";
  for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE,
                         PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA}) {
    for (const int bits : {1, 2, 4, 8, 16}) {
      if (bits < 8 && type != PNG_COLOR_TYPE_GRAY && type != PNG_COLOR_TYPE_PALETTE) continue;
      if (bits == 16 && type == PNG_COLOR_TYPE_PALETTE) continue;
      for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
        for (const bool transparent : {false, true}) {
          if (transparent && (type & PNG_COLOR_MASK_ALPHA) != 0) continue;
          SCOPED_TRACE(::testing::Message()
                       << "type " << type << ", " << bits << " bits, interlace " << interlace
                       << ", transparent " << transparent);
          write(file, {type, bits, interlace, transparent});
          const Image image = read_image(file);
          if (bits == 16) {
            expect_same_as_openimageio<std::uint16_t>(file, image);
          } else {
            expect_same_as_openimageio<std::uint8_t>(file, image);
          }
        }
      }
    }
  }
}

// Readers that check the whole file refuse a wrong checksum, even that of the last, empty chunk.
TEST(PngCodec, EveryChunkHasItsChecksum) {
  const std::string file = encode_png(3, 2, 3, std::vector<std::uint8_t>(18, 7));
  const auto number_at = [&](std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
      number = number << 8 | static_cast<std::uint8_t>(file[at + i]);
    return number;
  };
  std::string types;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number_at(at);
    ASSERT_LE(at + 12 + size, file.size());
    types += file.substr(at + 4, 4);
    const auto* typed = reinterpret_cast<const Bytef*>(file.data() + at + 4);
    EXPECT_EQ(number_at(at + 8 + size), crc32(0, typed, static_cast<uInt>(4 + size))) << types;
    at += 12 + size;
  }
  EXPECT_EQ(types, "IHDRIDATIEND");
}

TEST(PngCodec, WritesWhatItReads) {
  const TemporaryFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(kWidth * kHeight * channels));
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{3});
    const std::string png = encode_png(kWidth, kHeight, channels, bytes);
    const Image of_bytes = read_image(folder.write("bytes.png", png));
    EXPECT_EQ(of_bytes.channels, channels);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(of_bytes.pixels), bytes);
    std::vector<std::uint16_t> words(bytes.size());
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint16_t>(7919 * i);
    const Image image =
        read_image(folder.write("words.png", encode_png16(kWidth, kHeight, channels, words)));
    EXPECT_EQ(std::get<std::vector<std::uint16_t>>(image.pixels), words);
  }
}

}  // namespace
}  // namespace crowdface
