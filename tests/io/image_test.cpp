// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image.h"

#include <csignal>
#include <filesystem>
#include <limits>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/require.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Loading the library for images set and cancelled the alarm of the host, and handled the host's signals.
TEST(ImageLibrary, LeavesAlarmAndHandlersToTheHost) {
  const auto handlers = [] {
    std::vector<void (*)(int)> found;
    for (const int signal : {SIGABRT, SIGALRM, SIGSEGV, SIGTRAP}) {
      struct sigaction action {};
      EXPECT_EQ(::sigaction(signal, nullptr, &action), 0);
      found.push_back(action.sa_handler);
    }
    return found;
  };
  const auto before = handlers();  // a sanitizer has its own
  ::alarm(1000);
  encode_jpeg(1, 1, std::vector<std::uint8_t>(3));
  EXPECT_GT(::alarm(0), 900U);
  EXPECT_EQ(handlers(), before);
}

class ImageFiles : public ::testing::Test {
 protected:
  template <class T>
  path write(const std::string& name, int width, int height, int channels,
             const OIIO::TypeDesc& type, const std::vector<T>& values) {
    path file = folder_ / name;
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    auto output = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(output->open(file.string(), spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(OIIO::BaseTypeFromC<T>::value, values.data()));
    EXPECT_TRUE(output->close());
    return file;
  }

  path write_bytes(const std::string& name, std::string_view bytes) {
    return folder_.write(name, bytes);
  }

  testing::TemporaryFolder folder_;
};

std::string message_of(const path& file, const ImageLimits& limits = {}) {
  try {
    read_image(file, limits);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<std::uint8_t> counting_bytes(std::size_t count) {
  std::vector<std::uint8_t> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<std::uint8_t>(37 * i + 11);
  return values;
}

std::vector<std::uint16_t> counting_words(std::size_t count) {
  std::vector<std::uint16_t> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<std::uint16_t>(7919 * i + 3);
  return values;
}

/// As fractions, however they are stored.
std::vector<float> values_of(const Image& image) {
  std::vector<float> values;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < image.channels; ++c) values.push_back(image.at(x, y, c));
    }
  }
  return values;
}

template <class T>
void expect_fractions(const Image& image, const std::vector<T>& values) {
  const std::vector<float> found = values_of(image);
  ASSERT_EQ(found.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(found[i],
              static_cast<float>(values[i]) / static_cast<float>(std::numeric_limits<T>::max()));
  }
}

TEST_F(ImageFiles, EveryChannelCountOfPngComesBack) {
  for (int channels = 1; channels <= 4; ++channels) {
    const auto bytes = counting_bytes(std::size_t{15} * static_cast<std::size_t>(channels));
    const Image read = read_image(write("b.png", 5, 3, channels, OIIO::TypeDesc::UINT8, bytes));
    EXPECT_EQ(read.width, 5);
    EXPECT_EQ(read.height, 3);
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.alpha_channel, channels % 2 == 0 ? channels - 1 : -1);
    expect_fractions(read, bytes);
    const auto words = counting_words(bytes.size());
    expect_fractions(read_image(write("w.png", 5, 3, channels, OIIO::TypeDesc::UINT16, words)),
                     words);
  }
}

TEST_F(ImageFiles, TiffComesBackInEveryType) {
  const auto bytes = counting_bytes(4 * 4 * 4);
  expect_fractions(read_image(write("b.tif", 4, 4, 4, OIIO::TypeDesc::UINT8, bytes)), bytes);
  const auto words = counting_words(4 * 4 * 3);
  expect_fractions(read_image(write("w.tif", 4, 4, 3, OIIO::TypeDesc::UINT16, words)), words);
  const std::vector<float> floats = {-1.5F, 0.1F, 3e9F, 0.25F};
  EXPECT_EQ(values_of(read_image(write("f.tif", 2, 2, 1, OIIO::TypeDesc::FLOAT, floats))), floats);
}

TEST_F(ImageFiles, ExrKeepsItsFloats) {
  std::vector<float> floats;
  floats.reserve(30);
  for (int i = 0; i < 3 * 2 * 5; ++i) floats.push_back(0.1F * static_cast<float>(i) - 1);
  const Image five = read_image(write("five.exr", 3, 2, 5, OIIO::TypeDesc::FLOAT, floats));
  EXPECT_EQ(five.channels, 5);
  floats.resize(3 * 2 * 4);
  const Image rgba = read_image(write("rgba.exr", 3, 2, 4, OIIO::TypeDesc::FLOAT, floats));
  EXPECT_EQ(rgba.alpha_channel, 3);
  EXPECT_EQ(values_of(rgba), floats);
  const std::vector<float> halves = {0.5F, 1.0F, 0.25F, 2.0F};
  EXPECT_EQ(values_of(read_image(write("half.exr", 2, 2, 1, OIIO::TypeDesc::HALF, halves))),
            halves);
}

TEST_F(ImageFiles, ColoursUnderAlphaZeroSurvive) {
  const std::vector<std::uint8_t> clear = {200, 100, 50, 0, 10, 20, 30, 128};
  for (const char* name : {"clear.png", "clear.tif"}) {
    expect_fractions(read_image(write(name, 2, 1, 4, OIIO::TypeDesc::UINT8, clear)), clear);
  }
  expect_fractions(read_image(write_bytes("own.png", encode_png(2, 1, 4, clear))), clear);
}

TEST_F(ImageFiles, PngInMemoryComesBackAndIsReproducible) {
  for (int channels = 1; channels <= 4; ++channels) {
    const auto bytes = counting_bytes(std::size_t{31 * 17} * static_cast<std::size_t>(channels));
    const std::string png = encode_png(31, 17, channels, bytes);
    EXPECT_EQ(png, encode_png(31, 17, channels, bytes));
    EXPECT_THAT(png, Not(HasSubstr("tIME")));
    expect_fractions(read_image(write_bytes("memory.png", png)), bytes);
  }
}

TEST_F(ImageFiles, PngEncodingRefusesWrongSizes) {
  const std::vector<std::uint8_t> twelve(12);
  EXPECT_THROW(encode_png(2, 2, 4, twelve), BrokenPrecondition);
  EXPECT_THROW(encode_png(0, 2, 3, {}), BrokenPrecondition);
  EXPECT_THROW(encode_png(2, 1, 6, twelve), BrokenPrecondition);
}

TEST_F(ImageFiles, ContentDecidesNotTheName) {
  const auto bytes = counting_bytes(4 * 4 * 3);
  const path png = write("right.png", 4, 4, 3, OIIO::TypeDesc::UINT8, bytes);
  std::filesystem::rename(png, folder_ / "wrong.exr");
  expect_fractions(read_image(folder_ / "wrong.exr"), bytes);
}

TEST_F(ImageFiles, MissingFileIsMissingInput) {
  EXPECT_THROW(read_image(folder_ / "none.png"), MissingInput);
  EXPECT_THROW(read_image(folder_.path()), MissingInput);
}

TEST_F(ImageFiles, OtherContentIsRefusedByName) {
  const path text = write_bytes("text.png", "this is no picture");
  EXPECT_THAT(message_of(text),
              AllOf(HasSubstr("text.png"), HasSubstr("expected a PNG"), HasSubstr("this is")));
  EXPECT_THAT(message_of(write_bytes("empty.png", "")), HasSubstr("empty file"));
  EXPECT_THAT(message_of(write_bytes("p.png", "version https://git-lfs.github.com/spec/v1\n")),
              HasSubstr("git lfs pull"));
  EXPECT_THAT(message_of(write_bytes("x.jpg", "\xff\xd8\xff\xe0 JFIF")),
              HasSubstr("expected a PNG"));
}

std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  while (bytes-- > 0) text.push_back(static_cast<char>(value >> (8 * bytes)));
  return text;
}

/// A Photoshop file of 2 x 2 pixels.
std::string psd(int channels, const std::vector<std::uint8_t>& planes, std::string_view metadata,
                std::string_view layers) {
  return "8BPS" + big_endian(1, 2) + std::string(6, '\0') +
         big_endian(static_cast<std::uint32_t>(channels), 2) + big_endian(2, 4) + big_endian(2, 4) +
         big_endian(8, 2) + big_endian(3, 2) + big_endian(0, 4) +
         big_endian(static_cast<std::uint32_t>(metadata.size()), 4) + std::string(metadata) +
         big_endian(static_cast<std::uint32_t>(layers.size()), 4) + std::string(layers) +
         big_endian(0, 2) + std::string(planes.begin(), planes.end());
}

// Scanning software and games write these; "save it as PNG" stopped sound heads.
TEST_F(ImageFiles, FormatsOfTexturesAreRead) {
  const auto rgb = counting_bytes(16 * 16 * 3);
  const auto rgba = counting_bytes(16 * 16 * 4);
  for (const char* name : {"a.tga", "a.bmp"}) {
    const path file = write(name, 16, 16, 3, OIIO::TypeDesc::UINT8, rgb);
    expect_fractions(read_image(file), rgb);
    const std::string whole = read_file(file);
    EXPECT_NE(message_of(write_bytes("cut", whole.substr(0, 400))), "accepted") << name;
  }
  const Image holes = read_image(write("b.tga", 16, 16, 4, OIIO::TypeDesc::UINT8, rgba));
  EXPECT_EQ(holes.alpha_channel, 3);
  expect_fractions(holes, rgba);
  const path webp = write("a.webp", 16, 16, 3, OIIO::TypeDesc::UINT8, rgb);
  EXPECT_EQ(read_image(webp, {.allows_jpeg = true}).width, 16);
  EXPECT_THAT(message_of(webp), HasSubstr("a WebP image, whose values are inexact"));
  const Image gif = read_image(write("a.gif", 16, 16, 3, OIIO::TypeDesc::UINT8, rgb));
  EXPECT_EQ(gif.alpha_channel, 3);
  for (const char* begin : {"BM", "RIFF", "GIF8", "8BPS", "8BPS\0"})
    EXPECT_NE(message_of(write_bytes("short", begin)), "accepted") << begin;
}

TEST_F(ImageFiles, PhotoshopFilesAreReadWithoutTheirLayers) {
  const std::vector<std::uint8_t> planes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<std::uint8_t> pixels = {1, 5, 9, 2, 6, 10, 3, 7, 11, 4, 8, 12};
  const std::string layers = big_endian(8, 4) + "\xff\xff" + std::string(10, '\x7f');
  const Image image = read_image(write_bytes("a.psd", psd(3, planes, "8BIM junk", layers)));
  expect_fractions(image, pixels);
  EXPECT_EQ(image.alpha_channel, -1);
  std::vector<std::uint8_t> four = planes;
  four.insert(four.end(), {0, 255, 128, 255});
  expect_fractions(read_image(write_bytes("h.psd", psd(4, four, "", layers))), pixels);
  const std::string no_picture = "8BIM\x04\x21" + std::string(2, '\0') + big_endian(5, 4) +
                                 big_endian(1, 4) + std::string(1, '\0');
  EXPECT_THAT(message_of(write_bytes("e.psd", psd(3, planes, no_picture, layers))),
              HasSubstr("Maximize Compatibility"));
  const std::string whole = psd(3, planes, "8BIM junk", layers);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(message_of(write_bytes("cut", whole.substr(0, size))), "accepted") << size;
}

TEST_F(ImageFiles, EveryCutOfAFileIsRefused) {
  const auto bytes = counting_bytes(16 * 16 * 3);
  std::vector<float> floats(16 * 16 * 3);
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = static_cast<float>(bytes[i]);
  const path files[] = {write("a.png", 16, 16, 3, OIIO::TypeDesc::UINT8, bytes),
                        write("a.tif", 16, 16, 3, OIIO::TypeDesc::UINT8, bytes),
                        write("a.exr", 16, 16, 3, OIIO::TypeDesc::FLOAT, floats)};
  for (const path& file : files) {
    const std::string whole = read_file(file);
    EXPECT_EQ(message_of(file), "accepted");
    for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 61) {
      const path cut = write_bytes("cut", whole.substr(0, size));
      EXPECT_NE(message_of(cut), "accepted") << file << " after " << size << " bytes";
    }
    const path cut = write_bytes("cut", whole.substr(0, whole.size() - 1));
    EXPECT_NE(message_of(cut), "accepted") << file << " without its last byte";
  }
}

TEST_F(ImageFiles, LimitsAreKept) {
  const path file = write("limits.png", 6, 5, 3, OIIO::TypeDesc::UINT8, counting_bytes(90));
  EXPECT_THAT(message_of(file, {.max_side = 5}),
              AllOf(HasSubstr("at most 5 pixels"), HasSubstr("6 x 5")));
  EXPECT_THAT(message_of(file, {.max_channels = 2}), HasSubstr("at most 2 channels"));
  EXPECT_THAT(message_of(file, {.max_values = 89}), HasSubstr("at most 89 values"));
  EXPECT_EQ(message_of(file, {.max_side = 6, .max_channels = 3, .max_values = 90}), "accepted");
}

TEST_F(ImageFiles, NotFiniteValuesAreNamed) {
  std::vector<float> floats(4 * 3 * 2, 0.5F);
  floats[(4 * 1 + 2) * 2 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(message_of(write("nan.exr", 4, 3, 2, OIIO::TypeDesc::FLOAT, floats)),
              HasSubstr("NaN at column 3, row 2, channel 2"));
  floats.assign(24, 0.5F);
  floats[0] = -std::numeric_limits<float>::infinity();
  EXPECT_THAT(message_of(write("inf.exr", 4, 3, 2, OIIO::TypeDesc::FLOAT, floats)),
              HasSubstr("infinity at column 1, row 1, channel 1"));
}

TEST_F(ImageFiles, WideIntegersAreRefused) {
  const std::vector<std::uint32_t> wide(4, 7);
  EXPECT_THAT(message_of(write("wide.tif", 2, 2, 1, OIIO::TypeDesc::UINT32, wide)),
              HasSubstr("expected 8 or 16 bit"));
}

// As Nuke writes what has a bounding box.
TEST_F(ImageFiles, OfAnExrTheDisplayWindowIsRead) {
  const path file = folder_ / "part.exr";
  OIIO::ImageSpec spec(3, 2, 1, OIIO::TypeDesc::FLOAT);
  spec.x = 2;
  spec.y = -1;
  spec.full_width = 4;
  spec.full_height = 3;
  auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output->open(file.string(), spec));
  const std::vector<float> floats = {1, 2, 3, 4, 5, 6};
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, floats.data()));
  ASSERT_TRUE(output->close());
  const Image image = read_image(file);
  EXPECT_EQ(std::get<0>(image.pixels), (std::vector<float>{0, 0, 4, 5, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(read_image_size(file).width, 4);
}

// Editors note where a picture was cut out; it is whole all the same.
TEST_F(ImageFiles, PicturesWithAnOffsetAreRead) {
  for (const char* name : {"cut.png", "cut.tif"}) {
    const path file = folder_ / name;
    OIIO::ImageSpec spec(3, 2, 1, OIIO::TypeDesc::UINT8);
    spec.x = 5;
    spec.y = 7;
    auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output->open(file.string(), spec));
    const auto bytes = counting_bytes(6);
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, bytes.data()));
    ASSERT_TRUE(output->close());
    expect_fractions(read_image(file), bytes);
  }
}

TEST_F(ImageFiles, ExrReadsBackWithinHalfPrecisionAndHoldsNoTime) {
  const std::vector<float> pixels = {0, 0.25F, 1, 0.1F, 0.333F, 0.9F};
  const std::string bytes = encode_exr(2, 1, 3, pixels);
  EXPECT_EQ(bytes, encode_exr(2, 1, 3, pixels));
  const Image image = read_image(write_bytes("picture.exr", bytes));
  ASSERT_EQ(image.channels, 3);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_NEAR(values_of(image)[i], pixels[i], 6e-4F * pixels[i]);
  }
  EXPECT_THROW(encode_exr(2, 2, 3, pixels), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
