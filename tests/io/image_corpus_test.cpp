// SPDX-License-Identifier: Apache-2.0
// Test 8 of docs/reliability.md: damaged and absurd images are refused by name, whatever is wrong.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/io/image.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using testing::read_text;
using testing::TemporaryFolder;

class ImageCorpus : public ::testing::Test {
 protected:
  /// A picture of 16-bit or float values that do not compress to nothing.
  std::string picture(const char* name, const OIIO::TypeDesc& type, float odd_value) const {
    const fs::path file = folder_ / name;
    constexpr int kSide = 24;
    OIIO::ImageSpec spec(kSide, kSide, 3, type);
    std::vector<float> values(std::size_t{3} * kSide * kSide);
    std::mt19937 random(1);
    for (float& value : values) value = static_cast<float>(random() % 1000) / 1000.0F;
    values[700] = odd_value;
    auto output = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(output->open(file.string(), spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    EXPECT_TRUE(output->close());
    return read_text(file);
  }

  struct TiffForm {
    const char* compression;
    bool tiled, planes_apart;
    OIIO::TypeDesc type;
  };

  /// Of 48 x 48 pixels in nine tiles or six strips; its directory comes before them.
  std::string tiff(const TiffForm& form) const {
    constexpr int kSide = 48;
    OIIO::ImageSpec spec(kSide, kSide, 3, form.type);
    spec.attribute("compression", form.compression);
    spec.attribute("tiff:RowsPerStrip", 8);
    if (form.tiled) spec.tile_width = spec.tile_height = 16;
    if (form.planes_apart) spec.attribute("planarconfig", "separate");
    std::vector<std::uint8_t> values(std::size_t{3} * kSide * kSide);
    std::mt19937 random(1);
    for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random() % 7 * 30);
    const fs::path file = folder_ / "form.tif";
    auto output = OIIO::ImageOutput::create("tiff");
    EXPECT_TRUE(output->open(file.string(), spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, values.data())) << output->geterror();
    EXPECT_TRUE(output->close());
    return with_directory_first(read_text(file));
  }

  /// The same TIFF (classic, little endian) with its directory, and what that points to, in front of
  /// the pixels: then a cut leaves a directory that is whole.
  static std::string with_directory_first(const std::string& bytes) {
    const auto word = [&](std::size_t at, std::size_t size) {
      std::uint32_t value = 0;
      for (std::size_t i = size; i-- > 0;) {
        value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
      }
      return value;
    };
    const auto put = [](std::string& text, std::size_t at, std::uint32_t value) {
      for (std::size_t i = 0; i < 4; ++i) text[at + i] = static_cast<char>(value >> (8 * i));
    };
    // All that is old goes behind a copy of the directory; what it points to moves by that much.
    const std::size_t from = word(4, 4), entries = word(from, 2);
    std::string front = bytes.substr(0, 8) + bytes.substr(from, 2 + 12 * entries) + "\0\0\0\0"s;
    std::string rest = bytes.substr(8);
    std::string lists;
    put(front, 4, 8);
    std::vector<std::pair<std::size_t, std::size_t>> offsets;  // where, how many
    for (std::size_t e = 0; e < entries; ++e) {
      const std::size_t entry = 10 + 12 * e, old = from + 2 + 12 * e;
      const std::uint32_t tag = word(old, 2), type = word(old + 2, 2), count = word(old + 4, 4);
      const std::size_t sizes[13] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
      const std::size_t size = count * sizes[type];
      const bool inside = size <= 4;
      const std::size_t place = inside ? entry + 8 : front.size() + lists.size();
      if (!inside) {
        lists += bytes.substr(word(old + 8, 4), size);
        put(front, entry + 8, static_cast<std::uint32_t>(place));
      }
      if (tag == 273 || tag == 324) {
        EXPECT_EQ(type, 4U);
        offsets.emplace_back(place, count);
      }
    }
    front += lists;
    const auto moved = static_cast<std::uint32_t>(front.size() - 8);
    for (const auto& [place, count] : offsets) {
      for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t value = 0;
        for (std::size_t b = 4; b-- > 0;) {
          value = value << 8U | static_cast<unsigned char>(front[place + 4 * i + b]);
        }
        put(front, place + 4 * i, value + moved);
      }
    }
    return front + rest;
  }

  /// \return whether it was read.
  bool read(const std::string& bytes) {
    const fs::path file = folder_.write("mask.bin", bytes);
    try {
      const Image image = read_image(file);
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          for (int c = 0; c < image.channels; ++c) EXPECT_TRUE(std::isfinite(image.at(x, y, c)));
        }
      }
      return true;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), ::testing::StartsWith(file.string() + ": "));
      return false;
    }
  }

  /// \return why it was refused.
  std::string refusal(const std::string& bytes) const {
    const fs::path file = folder_.write("mask.bin", bytes);
    try {
      read_image(file);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "none";
  }

  TemporaryFolder folder_;
};

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(number >> shift);
  return bytes;
}

/// The checksum of a PNG's chunks.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::string png_chunk(const std::string& type, const std::string& content) {
  return big_endian(static_cast<std::uint32_t>(content.size())) + type + content +
         big_endian(crc32(type + content));
}

struct PngHeader {
  std::uint32_t width, height;
  char depth, colour_type;
};

/// A PNG of 100 bytes in which all is sound but that it holds no such picture.
std::string png_that_claims(const PngHeader& header) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(header.width) + big_endian(header.height) + header.depth +
                               header.colour_type + "\0\0\0"s) +
         png_chunk("IDAT", std::string(43, '\0')) + png_chunk("IEND", "");
}

// The decoder would take two gigabytes before it looks.
TEST_F(ImageCorpus, AnExrHeaderThatClaimsTooMuchIsRefusedBeforeItIsDecoded) {
  const std::string whole = picture("a.exr", OIIO::TypeDesc::FLOAT, 0.5F);
  for (const std::string& attribute :
       {"channels\0chlist"s, "compression\0compression"s, "displayWindow\0box2i"s}) {
    const std::size_t at = whole.find(attribute) + attribute.size() + 1;
    ASSERT_LT(at, whole.size());
    for (const char* size : {"\xff\xff\xff\x7f", "\xff\xff\xff\xff"}) {
      std::string bytes = whole;
      bytes.replace(at, 4, size, 4);
      EXPECT_THAT(refusal(bytes), ::testing::HasSubstr("header runs beyond the file's end"));
    }
  }
  // A value of another size than its type's: the decoder would go on from another place than we do.
  for (const std::string& attribute :
       {"channels\0chlist"s, "compression\0compression"s, "displayWindow\0box2i"s}) {
    std::string bytes = whole;
    const std::size_t size = whole.find(attribute) + attribute.size() + 1;
    bytes[size] = static_cast<char>(bytes[size] - 1);
    bytes.erase(size + 4, 1);
    EXPECT_THAT(refusal(bytes), ::testing::HasSubstr("are not of the type")) << attribute;
  }
  const std::string window = "dataWindow\0box2i"s;
  for (const int axis : {0, 1}) {
    std::string bytes = whole;
    const auto end =
        whole.find(window) + window.size() + 5 + 8 + 4 * static_cast<std::size_t>(axis);
    bytes.replace(end, 4, "\xff\xff\xff\x7f", 4);
    EXPECT_THAT(refusal(bytes), ::testing::HasSubstr("2147483648"));
  }
}

TEST_F(ImageCorpus, CutAnywhereIsRefused) {
  int refused = 0;
  for (const auto& [name, type] :
       {std::pair{"a.png", OIIO::TypeDesc::UINT8}, std::pair{"b.png", OIIO::TypeDesc::UINT16},
        std::pair{"c.tif", OIIO::TypeDesc::UINT16}, std::pair{"d.exr", OIIO::TypeDesc::FLOAT}}) {
    const std::string bytes = picture(name, type, 0.5F);
    EXPECT_TRUE(read(bytes)) << name;
    constexpr std::size_t kCuts = 40;
    for (std::size_t cut = 0; cut < kCuts; ++cut) {
      const std::size_t size = bytes.size() * cut / kCuts;
      EXPECT_FALSE(read(bytes.substr(0, size))) << name << " cut to " << size;
      ++refused;
    }
  }
  EXPECT_GE(refused, 100);
}

// The decoder took a strip that it could not read for one that it had, and its old memory for pixels.
TEST_F(ImageCorpus, ATiffCutAnywhereIsRefusedWhateverItsForm) {
  for (const char* compression : {"none", "lzw", "zip", "packbits"}) {
    for (const bool tiled : {false, true}) {
      for (const bool planes_apart : {false, true}) {
        for (const auto type : {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::FLOAT}) {
          const std::string bytes = tiff({compression, tiled, planes_apart, type});
          const auto what = ::testing::Message() << compression << (tiled ? ", tiles" : ", strips")
                                                 << (planes_apart ? ", planes" : "");
          EXPECT_TRUE(read(bytes)) << what;
          constexpr std::size_t kCuts = 30;
          // The last pixels end before what was the directory.
          const std::size_t pixels_end = bytes.size() - 400;
          for (std::size_t cut = 0; cut < kCuts; ++cut) {
            const std::size_t size = pixels_end * cut / kCuts;
            EXPECT_FALSE(read(bytes.substr(0, size))) << what << ", cut to " << size;
          }
        }
      }
    }
  }
}

TEST_F(ImageCorpus, ADamagedStripIsRefusedOrGivesTheSamePixelsEachTime) {
  std::mt19937 random(3);
  for (const char* compression : {"lzw", "zip", "packbits"}) {
    for (const bool planes_apart : {false, true}) {
      const std::string bytes = tiff({compression, false, planes_apart, OIIO::TypeDesc::UINT8});
      int refused = 0;
      for (int i = 0; i < 60; ++i) {
        std::string mutant = bytes;
        for (std::size_t k = 0; k < 8; ++k) {
          mutant[bytes.size() / 2 + random() % 200] = static_cast<char>(random());
        }
        const fs::path file = folder_.write("mutant.tif", mutant);
        try {
          const Image first = read_image(file);
          EXPECT_EQ(first.pixels, read_image(file).pixels) << compression;
        } catch (const InvalidInput&) {
          ++refused;
        }
      }
      if (compression != "packbits"s) {
        EXPECT_GT(refused, 20) << compression << planes_apart;
      }
    }
  }
}

// The decoder would take memory for all that is claimed before it looks.
TEST_F(ImageCorpus, ATiffThatClaimsMoreThanItHoldsIsRefusedBeforeItIsDecoded) {
  const std::string small_entry = "\x03\0\x01\0\0\0"s;
  for (const char* compression : {"none", "lzw", "zip", "packbits"}) {
    const std::string bytes = tiff({compression, false, false, OIIO::TypeDesc::UINT8});
    std::string huge = bytes;
    for (const std::string& tag : {"\0\x01"s, "\x01\x01"s, "\x16\x01"s}) {  // sides, rows a strip
      const std::size_t at = huge.find(tag + small_entry);
      ASSERT_NE(at, huge.npos);
      huge.replace(at + 8, 2, "\0\x40"s);  // 16384
    }
    EXPECT_THAT(refusal(huge), ::testing::HasSubstr("is too short for the 16384 x 16384 pixels"));
  }
  std::string jpeg = tiff({"none", false, false, OIIO::TypeDesc::UINT8});
  jpeg[jpeg.find("\x03\x01"s + small_entry) + 8] = 7;
  EXPECT_THAT(refusal(jpeg), ::testing::HasSubstr("found TIFF's compression 7"));
}

TEST_F(ImageCorpus, AJpegCutAnywhereIsRefused) {
  OIIO::ImageSpec spec(40, 30, 3, OIIO::TypeDesc::UINT8);
  const std::vector<std::uint8_t> values(std::size_t{3} * 40 * 30, 77);
  const fs::path file = folder_ / "a.jpg";
  auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::UINT8, values.data()) && output->close());
  const std::string bytes = read_text(file);
  EXPECT_EQ(read_image(file, {.allows_jpeg = true}).width, 40);
  for (std::size_t size = 3; size < bytes.size(); size += 7) {
    const fs::path cut = folder_.write("cut.jpg", bytes.substr(0, size));
    EXPECT_THROW(read_image(cut, {.allows_jpeg = true}), InvalidInput) << size;
  }
}

// Each alone is within its limits.
TEST_F(ImageCorpus, ImagesTogetherTakeNoMoreThanTheirMemory) {
  const std::uint64_t before = input_limits().image_bytes;
  limit_image_memory(std::uint64_t{5} * 100 * 100);
  const fs::path file = folder_.write(
      "grey.png", encode_png(100, 100, 1, std::vector<std::uint8_t>(std::size_t{100} * 100, 9)));
  {
    std::vector<Image> held;
    for (int i = 0; i < 5; ++i) held.push_back(read_image(file));
    EXPECT_THROW(read_image(file), InvalidInput);
    held.pop_back();
    EXPECT_NO_THROW(read_image(file));
  }
  EXPECT_NO_THROW(read_image(file));
  set_input_limit("image_bytes=" + std::to_string(before));
}

TEST_F(ImageCorpus, FlippedBytesAreReadOrRefused) {
  std::mt19937 random(2);
  for (const auto& [name, type] :
       {std::pair{"a.png", OIIO::TypeDesc::UINT16}, std::pair{"b.tif", OIIO::TypeDesc::UINT8},
        std::pair{"c.exr", OIIO::TypeDesc::HALF}}) {
    const std::string bytes = picture(name, type, 0.5F);
    for (int i = 0; i < 150; ++i) {
      std::string mutant = bytes;
      const std::size_t at =
          random() % (i % 2 == 0 ? std::min<std::size_t>(bytes.size(), 300) : bytes.size());
      mutant[at] = static_cast<char>(random());
      EXPECT_NO_THROW(read(mutant)) << name << ", byte " << at;
    }
  }
}

TEST_F(ImageCorpus, WhatIsNoNumberIsRefused) {
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    EXPECT_FALSE(read(picture("a.exr", OIIO::TypeDesc::FLOAT, value)));
    EXPECT_FALSE(read(picture("a.tif", OIIO::TypeDesc::FLOAT, value)));
  }
}

// Every checksum is right, so it is the sizes that are refused.
TEST_F(ImageCorpus, HugeClaimsAreRefused) {
  for (const std::uint32_t side : {0x7fffffffU, 0xffffffffU, 0x80000000U, 0U}) {
    EXPECT_THAT(refusal(png_that_claims({side, 1, 8, 2})), ::testing::HasSubstr("read as png"));
    EXPECT_THAT(refusal(png_that_claims({1, side, 8, 2})), ::testing::HasSubstr("read as png"));
  }
  for (const std::uint32_t side : {16385U, 1000000U}) {
    const auto told = ::testing::HasSubstr("expected at most 16384 pixels a side");
    EXPECT_THAT(refusal(png_that_claims({side, 1, 8, 2})), told);
    EXPECT_THAT(refusal(png_that_claims({1, side, 8, 2})), told);
  }
}

// The limits allow them, and six gigabytes would be taken before the first byte is decoded.
TEST_F(ImageCorpus, APngTooShortForWhatItClaimsIsRefusedBeforeItIsDecoded) {
  const std::string png = png_that_claims({16384, 16384, 16, 6});
  ASSERT_EQ(png.size(), 100U);
  EXPECT_THAT(refusal(png),
              ::testing::AllOf(::testing::HasSubstr("mask.bin: is too short for the 16384 x 16384 "
                                                    "pixels of 64 bits that it claims to hold"),
                               ::testing::HasSubstr("found 100 (cut short?)")));
  for (const PngHeader& header : {PngHeader{16384, 16384, 1, 0}, PngHeader{16384, 16384, 8, 2},
                                  PngHeader{4096, 1024, 8, 4}}) {
    EXPECT_THAT(refusal(png_that_claims(header)), ::testing::HasSubstr("is too short"));
  }
  // 250 bytes of rows may come from 100: the decoder finds that they do not.
  EXPECT_THAT(refusal(png_that_claims({50, 40, 1, 0})),
              ::testing::HasSubstr("is damaged or cut short"));
}

// Nothing compresses better, to a 1,024th.
TEST_F(ImageCorpus, AUniformPngIsRead) {
  constexpr int kSide = 2048;
  const std::vector<std::uint8_t> pixels(std::size_t{4} * kSide * kSide, 0);
  const std::string bytes = encode_png(kSide, kSide, 4, pixels);
  EXPECT_GT(pixels.size(), 600 * bytes.size());
  EXPECT_EQ(refusal(bytes), "none");
}

}  // namespace
}  // namespace crowdface
