// SPDX-License-Identifier: Apache-2.0
// Test 8 of docs/reliability.md: damaged and absurd images are refused by name, whatever is wrong.
#include <limits>
#include <random>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
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
  std::string picture(const char* name, OIIO::TypeDesc type, float odd_value) const {
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

  /// \return whether it was read.
  bool read(const std::string& bytes) {
    const fs::path file = folder_.write("mask.bin", bytes);
    try {
      const Image image = read_image(file);
      for (const float value : image.pixels) EXPECT_TRUE(std::isfinite(value));
      return true;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), ::testing::StartsWith(file.string() + ": "));
      return false;
    }
  }

  TemporaryFolder folder_;
};

// The decoder would take two gigabytes before it looks.
TEST_F(ImageCorpus, AnExrHeaderThatClaimsTooMuchIsRefusedBeforeItIsDecoded) {
  const std::string whole = picture("a.exr", OIIO::TypeDesc::FLOAT, 0.5F);
  const auto refusal = [&](const std::string& bytes) -> std::string {
    const fs::path file = folder_.write("mask.bin", bytes);
    try {
      read_image(file);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "none";
  };
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
      read(mutant);
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

// A header may claim any size; nothing is allocated for it.
TEST_F(ImageCorpus, HugeClaimsAreRefused) {
  const std::string png = picture("a.png", OIIO::TypeDesc::UINT8, 0.5F);
  for (const std::uint32_t side : {0x7fffffffU, 0xffffffffU, 0x80000000U, 1000000U, 0U}) {
    for (const std::size_t at : {16U, 20U}) {
      std::string mutant = png;
      for (std::size_t b = 0; b < 4; ++b) {
        mutant[at + b] = static_cast<char>(side >> (24 - 8 * b));
      }
      EXPECT_FALSE(read(mutant)) << side;
    }
  }
}

}  // namespace
}  // namespace crowdface
